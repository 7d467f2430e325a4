// Where a run begins.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "simulator/model/plant.h"

namespace plumbline::run {

/// A named coordinate, motor, pulley or joint and its value, SI.
using Named = std::pair<std::string, double>;

struct Start {
  std::vector<Named> positions;
  std::vector<Named> velocities;
  std::string
      height;  ///< position that is moved until the lowest foot is `clearance` above the floor; empty: none
  double clearance = 0.0;   ///< m
  double height_arm = 1.0;  ///< metres of foot for a unit of `height` (a boom's length where it is an angle)

  /// The value of a position or velocity; nullptr when it is not stated.
  double* position(const std::string& name);
  double* velocity(const std::string& name);
};

/// State of the plant: the independent positions that give the named ones their values and leave no cable
/// stretched (least squares, the smallest one where something is left open), velocities in the same way,
/// hidden states 0. What is named as a position and not as a velocity is at rest. Clearance is above the
/// terrain's floor: the plant should stand on level ground. Throws std::runtime_error when the plant cannot
/// take the pose.
Eigen::VectorXd start_state(model::Plant& plant, const Start& start);

}  // namespace plumbline::run
