// Rotations as vectors: axis times angle, and roll, pitch, yaw.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace plumbline::model {

/// R = exp([r]): a turn by |r| about r.
inline Eigen::Matrix3d rotation_of(const Eigen::Vector3d& r) {
  const double angle = r.norm();
  return angle > 0.0 ? Eigen::AngleAxisd(angle, r / angle).toRotationMatrix()
                     : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

/// Roll, pitch and yaw as in URDF: about x, then the fixed y, then the fixed z.
inline Eigen::Matrix3d roll_pitch_yaw(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// The shortest r with R = exp([r]), |r| <= pi.
inline Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double sine = q.vec().norm();
  if (sine == 0.0) {
    return Eigen::Vector3d::Zero();
  }
  const double half = std::atan2(sine, std::abs(q.w()));
  return std::copysign(2.0 * half / sine, q.w()) * q.vec();
}

/// The turn from `from` to `to`, seen in the axes of `from`: exp([from]) exp([e]) = exp([to]).
inline Eigen::Vector3d turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return rotation_vector(rotation_of(from).transpose() * rotation_of(to));
}

/// J with exp([r + dr]) = exp([r]) exp([J dr]) to first order: the right Jacobian of the rotations.
/// Source: T. Barfoot, State Estimation for Robotics, 2017, equation 7.87 (transposed).
inline Eigen::Matrix3d right_jacobian(const Eigen::Vector3d& r) {
  const double angle = r.norm();
  Eigen::Matrix3d cross;
  cross << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
  constexpr double kSmall = 1e-4;  // below it the series is exact to rounding
  const double a = angle < kSmall ? 0.5 : (1.0 - std::cos(angle)) / (angle * angle);
  const double b = angle < kSmall ? 1.0 / 6.0 : (angle - std::sin(angle)) / (angle * angle * angle);
  return Eigen::Matrix3d::Identity() - a * cross + b * cross * cross;
}

}  // namespace plumbline::model
