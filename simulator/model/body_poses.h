// Where the links of a skeleton are for given joint positions.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::model {

/// X_WB of every body, in the skeleton's order. `q` has one position (rad or m) for each joint that moves, in
/// the skeleton's order:
///   X_WB = X_WP X_PJ J(q) X_BJ^-1,   J a turn about the joint's axis, or a shift along it.
std::vector<Eigen::Isometry3d> body_poses(const Skeleton& skeleton, const Eigen::VectorXd& q);

}  // namespace plumbline::model
