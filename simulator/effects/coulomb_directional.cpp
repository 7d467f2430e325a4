#include "simulator/effects/coulomb_directional.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kDifference, kSmoothingSpeed };

}  // namespace

const Declaration& CoulombDirectional::declaration() const {
  static const Declaration kDeclaration{
      "coulomb_directional",
      "difference of Coulomb friction between the two directions",
      "f = -difference*tanh(v/smoothing_speed)^2",
      "Armstrong-Helouvry, Control of Machines with Friction, 1991 (friction that depends on the direction)",
      {Place::coordinate, Place::motor},
      {any("difference", "{force}", "half of friction forwards minus friction backwards"), smoothing_speed()},
      {},
      "Negative in one direction: alone it feeds energy. Passive together with symmetric Coulomb friction of "
      "level >= |difference|."};
  return kDeclaration;
}

Values CoulombDirectional::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force, smoothing_speed_for(scales)};
}

std::vector<Values> CoulombDirectional::starts(const Scales& scales) const {
  Values p = null_values();
  p[kSmoothingSpeed] = smoothing_speed_for(scales);
  return {p};
}

double CoulombDirectional::force(const Motion& m, const double* /*state*/, const double* p) const {
  const double direction = smooth_sign(m.velocity, p[kSmoothingSpeed]);
  return -p[kDifference] * direction * direction;
}

}  // namespace plumbline::effects
