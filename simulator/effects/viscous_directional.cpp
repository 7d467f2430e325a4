#include "simulator/effects/viscous_directional.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kDifference };

}  // namespace

const Declaration& ViscousDirectional::declaration() const {
  static const Declaration kDeclaration{
      "viscous_directional",
      "difference of viscous friction between the two directions",
      "f = -difference*|v|",
      "Armstrong-Helouvry, Control of Machines with Friction, 1991 (friction that depends on the direction)",
      {Place::coordinate, Place::motor},
      {any("difference", "{force} s/{position}", "half of damping forwards minus damping backwards")},
      {},
      "Negative in one direction: alone it feeds energy. Passive together with symmetric viscous damping >= "
      "|difference|."};
  return kDeclaration;
}

Values ViscousDirectional::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / s.velocity};
}

std::vector<Values> ViscousDirectional::starts(const Scales& /*scales*/) const { return {null_values()}; }

double ViscousDirectional::force(const Motion& m, const double* /*state*/, const double* p) const {
  return -p[kDifference] * std::abs(m.velocity);
}

void ViscousDirectional::switches(const Motion& m, const double* /*p*/, std::vector<double>& g) const {
  g.push_back(m.velocity);  // kink of |v|
}

}  // namespace plumbline::effects
