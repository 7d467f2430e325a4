// A motion of MABEL that no simulation is needed for: from a crouch with load to the air.
#pragma once

#include <map>
#include <string>

#include "simulator/render/motion.h"

namespace plumbline::render {

/// Two samples, at 0 s and 1 s: knees bent and both feet loaded; then in the air with the torso leaning.
inline Motion example_motion(const model::Plant& plant) {
  const std::map<std::string, Eigen::Vector2d> ends{
      {"hip_z", {0.86, 1.12}},       {"hip_left", {0.50, 0.25}},     {"knee_left", {-0.95, -0.60}},
      {"hip_right", {0.35, -0.10}},  {"knee_right", {-0.85, -0.45}}, {"torso", {0.10, -0.20}},
      {"mLA_left", {-1.0, 1.5}},     {"mLA_right", {0.5, 9.0}},      {"mLS_left", {11.0, 9.0}},
      {"mLS_right", {14.0, 7.0}},    {"bsp_left", {0.50, 0.0}},      {"bsp_right", {0.30, 0.0}},
      {"boom_pitch", {-0.06, 0.06}}, {"tower", {0.0, -0.15}}};
  Motion motion;
  motion.time = Eigen::Vector2d(0.0, 1.0);
  motion.positions = Eigen::MatrixXd::Zero(plant.positions(), 2);
  const std::vector<std::string> names = plant.state_names();
  for (const auto& [name, values] : ends) {
    for (Eigen::Index i = 0; i < plant.positions(); ++i) {
      if (names[static_cast<std::size_t>(i)] == "position of " + name) {
        motion.positions.row(i) = values.transpose();
      }
    }
  }
  motion.foot_forces.assign(2, Eigen::Matrix3Xd::Zero(3, 2));
  motion.foot_forces[0].col(0) << -60.0, 0.0, 520.0;
  motion.foot_forces[1].col(0) << 90.0, 0.0, 380.0;
  motion.phase = {2, 1};
  return motion;
}

}  // namespace plumbline::render
