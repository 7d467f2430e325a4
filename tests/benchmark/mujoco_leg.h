// The peer of the plant's benchmark: two links on hinges in MuJoCo.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace plumbline::benchmarks {

/// The leg bench's thigh and shin, with the inertia that the leg-shape drive and C_Spring add to the knee.
/// What a tree of two links with diagonal armature cannot express is left out: the leg-angle drive, C_Shin
/// and C_Spring's weight.
class MujocoLeg {
 public:
  /// Throws std::runtime_error with MuJoCo's reason.
  MujocoLeg();
  ~MujocoLeg();
  MujocoLeg(const MujocoLeg&) = delete;
  MujocoLeg& operator=(const MujocoLeg&) = delete;

  /// Accelerations of hip and knee joint, rad/s^2 (mj_forward).
  Eigen::Vector2d accelerations(const Eigen::Vector2d& q, const Eigen::Vector2d& v,
                                const Eigen::Vector2d& torques);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumbline::benchmarks
