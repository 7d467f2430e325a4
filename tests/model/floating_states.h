// A free or ball joint's chart (Rz(yaw) Ry(pitch) Rx(roll)) as rotation, angular velocity and acceleration.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plumbline::test {

using Eigen::Vector3d;

/// angles: yaw, pitch, roll, rad.
inline Eigen::Matrix3d rotation_of(const Vector3d& angles) {
  return (Eigen::AngleAxisd(angles[0], Vector3d::UnitZ()) * Eigen::AngleAxisd(angles[1], Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles[2], Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Yaw, pitch and roll of a rotation.
inline Vector3d angles_of(const Eigen::Matrix3d& R) {
  return {std::atan2(R(1, 0), R(0, 0)), std::asin(-R(2, 0)), std::atan2(R(2, 1), R(2, 2))};
}

/// The body's angular velocity in its own axes is E(angles) times the angles' rates (Diebel, Representing
/// Attitude, Stanford 2006, section 5.6).
inline Eigen::Matrix3d rates_map(const Vector3d& angles) {
  const double st = std::sin(angles[1]), ct = std::cos(angles[1]);
  const double sf = std::sin(angles[2]), cf = std::cos(angles[2]);
  Eigen::Matrix3d E;
  E << -st, 0.0, 1.0, ct * sf, cf, 0.0, ct * cf, -sf, 0.0;
  return E;
}

/// d/dt of that: E times the angles' accelerations, and what the rates make.
inline Vector3d angular_acceleration(const Vector3d& angles, const Vector3d& rates, const Vector3d& second) {
  const double st = std::sin(angles[1]), ct = std::cos(angles[1]);
  const double sf = std::sin(angles[2]), cf = std::cos(angles[2]);
  Eigen::Matrix3d turned;  // dE/dt
  turned << -ct * rates[1], 0.0, 0.0, -st * sf * rates[1] + ct * cf * rates[2], -sf * rates[2], 0.0,
      -st * cf * rates[1] - ct * sf * rates[2], -cf * rates[2], 0.0;
  return rates_map(angles) * second + turned * rates;
}

}  // namespace plumbline::test
