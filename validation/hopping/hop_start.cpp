#include "validation/hopping/hop_start.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "validation/hopping/hip_watch.h"

namespace plumbline::validation {
namespace {

using Wanted = std::vector<std::pair<std::string, double>>;

/// Independent coordinates that give the named ones their values and leave no cable stretched.
Eigen::VectorXd solve_for(model::Plant& plant, const Wanted& wanted, bool velocities) {
  const Eigen::Index n = plant.positions();
  const auto rows = static_cast<Eigen::Index>(wanted.size());
  const Eigen::MatrixXd& stretch = plant.stretch_map();
  Eigen::MatrixXd C(rows + stretch.rows(), n);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(rows + stretch.rows());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  for (Eigen::Index r = 0; r < rows; ++r) {
    const auto& [name, value] = wanted[static_cast<std::size_t>(r)];
    for (Eigen::Index i = 0; i < n; ++i) {
      x[n + i] = 1.0;
      C(r, i) = plant.velocity_of(name, x.data());
      x[n + i] = 0.0;
    }
    y[r] = value - (velocities ? 0.0 : plant.position_of(name, x.data()));
  }
  C.bottomRows(stretch.rows()) = stretch;
  return C.completeOrthogonalDecomposition().solve(y);
}

}  // namespace

Eigen::VectorXd start_state(model::Plant& plant, const controllers::HoppingConfig& config,
                            const HopStart& start) {
  const auto [in_the_plane, travel, height] = hip_axes(plant.model());
  const double arm = in_the_plane ? 1.0 : config.boom_length;
  const controllers::HoppingParameters& p = config.parameters;
  Wanted pose{{travel, 0.0},
              {"torso", p.h_T0 + start.torso},
              {"leg_angle_left", -0.5 * p.delta_LA - p.h_T0},
              {"leg_angle_right", 0.5 * p.delta_LA - p.h_T0},
              {"leg_shape_left", p.h_LS_left},
              {"leg_shape_right", p.h_LS_right},
              {"bsp_left", 0.0},
              {"bsp_right", 0.0},
              {height, 0.0}};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const Eigen::Index n = plant.positions();
  for (int round = 0; round < 10; ++round) {
    x.head(n) = solve_for(plant, pose, false);
    double deepest = -1e9;
    for (const model::Touch& touch : plant.touches(x.data())) {
      deepest = std::max(deepest, touch.depth);
    }
    pose.back().second += (deepest + start.drop) / arm;
  }
  Wanted motion = pose;
  for (auto& [name, value] : motion) {
    value = name == travel ? start.speed / arm : 0.0;
  }
  x.segment(n, n) = solve_for(plant, motion, true);
  return x;
}

}  // namespace plumbline::validation
