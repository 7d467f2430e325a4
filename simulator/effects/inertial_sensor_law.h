// A gyroscope or an accelerometer of three axes that does not read what it feels.
#pragma once

#include <Eigen/Core>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// reading = gain actual + bias, in the sensor's stated axes.
struct InertialReading {
  Eigen::Matrix3d gain = Eigen::Matrix3d::Identity();
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();  ///< rad/s of a gyroscope, m/s^2 of an accelerometer
};

/// An error of a gyroscope or an accelerometer of three axes, which is its place as a whole, by its name
/// without a component. The unit {inertial} of a parameter is rad/s of the one and m/s^2 of the other. The
/// laws of one sensor act one after the other.
class InertialSensorLaw : public SensorLaw {
 public:
  virtual InertialReading inertial_reading(const double* p) const = 0;
  /// Of one component alone nothing can be said.
  double reading(double actual, const double* /*p*/) const final { return actual; }
};

}  // namespace plumbline::effects
