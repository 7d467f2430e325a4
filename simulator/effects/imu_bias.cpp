#include "simulator/effects/imu_bias.h"

#include "simulator/effects/parameters.h"

namespace plumbline::effects {

const Declaration& ImuBias::declaration() const {
  static const Declaration kDeclaration{
      "imu_bias",
      "a gyroscope or an accelerometer whose zero is displaced",
      "reading_x = actual_x + x; reading_y = actual_y + y; reading_z = actual_z + z",
      "Titterton and Weston, Strapdown Inertial Navigation Technology, 2nd edition, 2004, chapter 8; "
      "Tedaldi, Pretto and Menegatti, ICRA 2014, section III",
      {Place::sensor},
      {any("x", "{inertial}", "reading of the first axis at zero"), any("y", "{inertial}", "of the second"),
       any("z", "{inertial}", "of the third")},
      {},
      ""};
  return kDeclaration;
}

Values ImuBias::typical(const Scales& scales) const { return Values(3, guarded(scales).position); }

std::vector<Values> ImuBias::starts(const Scales& /*scales*/) const { return {null_values()}; }

InertialReading ImuBias::inertial_reading(const double* p) const {
  InertialReading reading;
  reading.bias << p[0], p[1], p[2];
  return reading;
}

}  // namespace plumbline::effects
