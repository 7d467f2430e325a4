#include "simulator/effects/gear_friction.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kCoefficient, kSmoothingSpeed };

}  // namespace

const Declaration& GearFriction::declaration() const {
  static const Declaration kDeclaration{
      "gear_friction",
      "dry friction in proportion to what the motor's gear passes on",
      "f = -coefficient*|load|*tanh(v/smoothing_speed)",
      "Dohring, Lee and Newman, A load-dependent transmission friction model: theory and experiments, IEEE "
      "ICRA 1993",
      {Place::motor},
      {non_negative("coefficient", "1", "friction force per torque that is passed on"), smoothing_speed()},
      {},
      ""};
  return kDeclaration;
}

Values GearFriction::typical(const Scales& scales) const { return {1.0, smoothing_speed_for(scales)}; }

std::vector<Values> GearFriction::starts(const Scales& scales) const {
  Values p = null_values();
  p[kSmoothingSpeed] = smoothing_speed_for(scales);
  return {p};
}

double GearFriction::force(const Motion& m, const double* /*state*/, const double* p) const {
  return -p[kCoefficient] * std::abs(m.load) * smooth_sign(m.velocity, p[kSmoothingSpeed]);
}

}  // namespace plumbline::effects
