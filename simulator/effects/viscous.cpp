#include "simulator/effects/viscous.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kDamping };

}  // namespace

const Declaration& Viscous::declaration() const {
  static const Declaration kDeclaration{
      "viscous",
      "viscous friction, in proportion to the velocity",
      "f = -damping*v",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, equations 8 and 16",
      {Place::coordinate, Place::motor},
      {non_negative("damping", "{force} s/{position}", "damping coefficient")},
      {},
      ""};
  return kDeclaration;
}

Values Viscous::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / s.velocity};
}

std::vector<Values> Viscous::starts(const Scales& /*scales*/) const { return {null_values()}; }

double Viscous::force(const Motion& m, const double* /*state*/, const double* p) const {
  return -p[kDamping] * m.velocity;
}

}  // namespace plumbline::effects
