// A robot's bodies as straight lines between joints: stick figures, and a stand-in where no shape is known.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::render {

/// A line of one body, in its frame, m.
struct Stick {
  int body = 0;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

/// From each body's joint to the joints that it carries and to its feet; lines shorter than a centimetre are
/// left out. A body whose centre of mass lies further out than any of them gets a line of twice that
/// distance through it: a uniform rod has its centre in the middle. Bodies fixed to the world get lines only
/// between joints.
std::vector<Stick> sticks_of(const model::Model& model);

/// Half the longest stick of each body, as a direction from its joint; zero for a body without one.
std::vector<Eigen::Vector3d> main_directions(const model::Skeleton& skeleton,
                                             const std::vector<Stick>& sticks);

}  // namespace plumbline::render
