#include "simulator/effects/coulomb.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kLevel, kSmoothingSpeed };

}  // namespace

const Declaration& Coulomb::declaration() const {
  static const Declaration kDeclaration{
      "coulomb",
      "Coulomb friction, of constant level against the motion",
      "f = -level*tanh(v/smoothing_speed)",
      "Olsson, Astrom, Canudas de Wit, Gafvert and Lischinsky, Friction models and friction compensation, "
      "European J. of Control 4, 1998",
      {Place::coordinate, Place::motor},
      {non_negative("level", "{force}", "friction force while sliding"), smoothing_speed()},
      {},
      ""};
  return kDeclaration;
}

Values Coulomb::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force, smoothing_speed_for(scales)};
}

std::vector<Values> Coulomb::starts(const Scales& scales) const {
  Values p = null_values();
  p[kSmoothingSpeed] = smoothing_speed_for(scales);
  return {p};
}

double Coulomb::force(const Motion& m, const double* /*state*/, const double* p) const {
  return -p[kLevel] * smooth_sign(m.velocity, p[kSmoothingSpeed]);
}

}  // namespace plumbline::effects
