// MABEL's published gait on its design model, for the tests of this folder.
#pragma once

#include "validation/studies/walking/rigid_gait.h"

namespace plumbline::validation {

inline Eigen::Vector3d start_of(const RigidGait& gait) {
  return {gait.start.at("theta_rate"), gait.start.at("spring"), gait.start.at("spring_rate")};
}

/// The gait and its step that repeats, found once for all tests of a program.
struct Found {
  RigidGait gait = read_rigid_gait(PLUMBLINE_ROOT "/robots/mabel/walking_design.yaml");
  RigidWalker walker{gait};
  RigidGaitOptions options;
  RigidWalker::FixedPoint point;
  Found() {
    options.tolerance = 1e-7;
    point = walker.fixed_point(start_of(gait), options);
  }
};
inline Found& found() {
  static Found one;
  return one;
}

}  // namespace plumbline::validation
