#include "simulator/effects/load_friction.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kCoefficient, kSmoothingSpeed };

}  // namespace

const Declaration& LoadFriction::declaration() const {
  static const Declaration kDeclaration{
      "load_friction",
      "dry friction in proportion to the load that the motor carries",
      "f = -coefficient*|load|*tanh(v/smoothing_speed)",
      "Hamon, Gautier and Garrec, Dynamic identification of robots with a dry friction model depending on "
      "load and velocity, IROS 2010",
      {Place::motor},
      {non_negative("coefficient", "1", "friction force per load"), smoothing_speed()},
      {},
      ""};
  return kDeclaration;
}

Values LoadFriction::typical(const Scales& scales) const { return {1.0, smoothing_speed_for(scales)}; }

std::vector<Values> LoadFriction::starts(const Scales& scales) const {
  Values p = null_values();
  p[kSmoothingSpeed] = smoothing_speed_for(scales);
  return {p};
}

double LoadFriction::force(const Motion& m, const double* /*state*/, const double* p) const {
  return -p[kCoefficient] * std::abs(m.load) * smooth_sign(m.velocity, p[kSmoothingSpeed]);
}

}  // namespace plumbline::effects
