#include "simulator/effects/imu_misalignment.h"

#include <Eigen/Geometry>
#include <string>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

Parameter axis_turn(const std::string& name, const std::string& meaning) {
  return {name, "rad", meaning, 0.0, -kPi, kPi, Scale::linear, false};
}

}  // namespace

const Declaration& ImuMisalignment::declaration() const {
  static const Declaration kDeclaration{
      "imu_misalignment",
      "a gyroscope or an accelerometer whose axes are turned against their mounting",
      "reading = exp(-[r])*actual, r = (x, y, z)",
      "Titterton and Weston, Strapdown Inertial Navigation Technology, 2nd edition, 2004, chapter 8 and "
      "section 3.6",
      {Place::sensor},
      {axis_turn("x", "rotation vector of the axes, in the stated ones"),
       axis_turn("y", "its second component"), axis_turn("z", "its third component")},
      {},
      ""};
  return kDeclaration;
}

Values ImuMisalignment::typical(const Scales& /*scales*/) const { return Values(3, 0.1); }

std::vector<Values> ImuMisalignment::starts(const Scales& /*scales*/) const { return {null_values()}; }

InertialReading ImuMisalignment::inertial_reading(const double* p) const {
  InertialReading reading;
  const Eigen::Vector3d r(p[0], p[1], p[2]);
  if (r.norm() > 0.0) {
    reading.gain = Eigen::AngleAxisd(-r.norm(), r.normalized()).toRotationMatrix();
  }
  return reading;
}

}  // namespace plumbline::effects
