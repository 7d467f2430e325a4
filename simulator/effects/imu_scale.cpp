#include "simulator/effects/imu_scale.h"

#include <string>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

Parameter scale_factor(const std::string& name, const std::string& meaning) {
  return {name, "1", meaning, 1.0, kSmallestPositive, kInfinity, Scale::linear, false};
}

}  // namespace

const Declaration& ImuScale::declaration() const {
  static const Declaration kDeclaration{
      "imu_scale",
      "a gyroscope or an accelerometer whose scale factors are wrong",
      "reading_x = x*actual_x; reading_y = y*actual_y; reading_z = z*actual_z",
      "Titterton and Weston, Strapdown Inertial Navigation Technology, 2nd edition, 2004, chapter 8; "
      "Tedaldi, Pretto and Menegatti, ICRA 2014, section III",
      {Place::sensor},
      {scale_factor("x", "reading over true value of the first axis"),
       scale_factor("y", "of the second axis"), scale_factor("z", "of the third axis")},
      {},
      ""};
  return kDeclaration;
}

Values ImuScale::typical(const Scales& /*scales*/) const { return Values(3, 1.0); }

std::vector<Values> ImuScale::starts(const Scales& /*scales*/) const { return {null_values()}; }

InertialReading ImuScale::inertial_reading(const double* p) const {
  InertialReading reading;
  reading.gain.diagonal() << p[0], p[1], p[2];
  return reading;
}

}  // namespace plumbline::effects
