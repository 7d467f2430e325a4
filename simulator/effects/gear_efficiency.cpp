#include "simulator/effects/gear_efficiency.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kDriving, kDriven, kSmoothingSpeed };

Parameter loss(const std::string& name, const std::string& meaning) {
  return {name, "1", meaning, 0.0, 0.0, 1.0, Scale::linear, false};
}

}  // namespace

const Declaration& GearEfficiency::declaration() const {
  static const Declaration kDeclaration{
      "gear_efficiency",
      "a gear that loses another share of the power when it is driven than when it drives",
      "f = -0.5*((loss_driving + loss_driven)*|load|*s + (loss_driving - loss_driven)*load*s^2); s = "
      "tanh(v/smoothing_speed)",
      "Wang and Kim, Directional efficiency in geared transmissions: characterization of backdrivability "
      "towards improved proprioceptive control, IEEE ICRA 2015; Dohring, Lee and Newman, IEEE ICRA 1993",
      {Place::motor},
      {loss("loss_driving",
            "torque lost per torque that is passed on while the motor drives: 1/efficiency - 1"),
       loss("loss_driven",
            "torque lost per torque that is passed on while the motor is driven: 1 - efficiency"),
       smoothing_speed()},
      {},
      ""};
  return kDeclaration;
}

Values GearEfficiency::typical(const Scales& scales) const { return {1.0, 1.0, smoothing_speed_for(scales)}; }

std::vector<Values> GearEfficiency::starts(const Scales& scales) const {
  Values p = null_values();
  p[kSmoothingSpeed] = smoothing_speed_for(scales);
  return {p};
}

double GearEfficiency::force(const Motion& m, const double* /*state*/, const double* p) const {
  const double s = smooth_sign(m.velocity, p[kSmoothingSpeed]);
  return -0.5 *
         ((p[kDriving] + p[kDriven]) * std::abs(m.load) * s + (p[kDriving] - p[kDriven]) * m.load * s * s);
}

}  // namespace plumbline::effects
