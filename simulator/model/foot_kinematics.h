// Feet as points that move: position, velocity, Jacobian, and what is left of their acceleration.
#pragma once

#include <Eigen/Core>
#include <string>

#include "simulator/model/mechanism.h"
#include "simulator/model/plant.h"

namespace plumbline::model {

/// The velocity of a point of the robot is J w, its acceleration J dw/dt + bias, w = dz/dt of the plant's
/// independent positions z.
struct PointMotion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in the world, m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();      ///< (dJ/dt) w, m/s^2
  Eigen::MatrixXd jacobian;                            ///< 3 x positions
};

/// Feet of a plant, whether a ground presses them or not. Geometry is the skeleton's: a base that an effect
/// bends (boom) is not followed. Not thread-safe: one object for each thread.
class FootKinematics {
 public:
  explicit FootKinematics(const Plant& plant);

  /// Of one of the model's feet at the state x. Throws std::out_of_range.
  PointMotion foot(int foot, const double* x);
  /// Index of a foot by its name; throws InputError.
  int index_of(const std::string& foot) const;
  /// d(position of a joint, coordinate, motor or pulley)/dz, 1 x positions. Throws InputError for an unknown
  /// name.
  Eigen::RowVectorXd row_of(const std::string& name) const;

 private:
  const Plant& plant_;
  Mechanism mechanism_;
  Eigen::MatrixXd tree_map_;  // d(joint positions)/dz
  Eigen::VectorXd q_, v_, h_;
  Eigen::MatrixXd M_;
};

}  // namespace plumbline::model
