#include "simulator/run/start.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulator/model/joint_chain.h"

namespace plumbline::run {
namespace {

constexpr int kRounds = 10;        // of moving the height: a boom's end runs on a circle
constexpr double kReached = 1e-6;  // rad or m, beside a pose that was asked for
constexpr double kDeepest = -1e9;  // m, of a robot without feet

double* find(std::vector<Named>& list, const std::string& name) {
  for (Named& one : list) {
    if (one.first == name) {
      return &one.second;
    }
  }
  return nullptr;
}

/// Positions, or velocities at the positions `at`, that keep the loops closed.
Eigen::VectorXd on_loops(model::Plant& plant, const Eigen::MatrixXd& C, const Eigen::VectorXd& y,
                         bool velocities, const Eigen::VectorXd& at) {
  if (velocities) {
    return plant.closure()->velocities(C, y, at);
  }
  Eigen::VectorXd z = plant.home();
  if (!plant.closure()->close(C, y, z)) {
    throw std::runtime_error(
        "the start cannot be reached: no position with these values closes the loops of " +
        plant.model().file);
  }
  return z;
}

/// Independent coordinates that give the named ones their values and leave no cable stretched.
Eigen::VectorXd solve_for(model::Plant& plant, const std::vector<Named>& wanted, bool velocities,
                          const Eigen::VectorXd& at = {}) {
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
  if (plant.closure() != nullptr) {
    return on_loops(plant, C, y, velocities, at);
  }
  return C.completeOrthogonalDecomposition().solve(y);
}

void check(model::Plant& plant, const std::vector<Named>& wanted, const Eigen::VectorXd& x,
           bool velocities = false) {
  for (const auto& [name, value] : wanted) {
    const double reached = velocities ? plant.velocity_of(name, x.data()) : plant.position_of(name, x.data());
    if (std::abs(reached - value) > kReached) {
      throw std::runtime_error(
          "the start cannot be reached: " + std::string(velocities ? "the speed of " : "") + name +
          " would be " + std::to_string(reached) + ", not " + std::to_string(value));
    }
  }
}

void check_charts(const model::Plant& plant, const Eigen::VectorXd& x) {
  for (const int joint : plant.model().skeleton.charts) {
    const std::string& name = plant.model().skeleton.joints[static_cast<std::size_t>(joint)].name;
    const std::string refusal =
        model::chart_refusal(name, plant.position_of(name, x.data()), model::kLeastCosineOfPitch);
    if (!refusal.empty()) {
      throw std::runtime_error(refusal);
    }
  }
}

}  // namespace

double* Start::position(const std::string& name) { return find(positions, name); }
double* Start::velocity(const std::string& name) { return find(velocities, name); }

Eigen::VectorXd start_state(model::Plant& plant, const Start& start) {
  std::vector<Named> pose = start.positions;
  const bool lifted = !start.height.empty();
  if (lifted && find(pose, start.height) == nullptr) {
    pose.emplace_back(start.height, 0.0);
  }
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const Eigen::Index n = plant.positions();
  for (int round = 0; round < (lifted ? kRounds : 1); ++round) {
    x.head(n) = solve_for(plant, pose, false);
    if (lifted) {
      double deepest = kDeepest;
      for (const model::Touch& touch : plant.touches(x.data())) {
        deepest = std::max(deepest, touch.depth);
      }
      *find(pose, start.height) += (deepest + start.clearance) / start.height_arm;
    }
  }
  // Where loops tie the pose's coordinates together, those that are not asked to move follow the others.
  std::vector<Named> motion = plant.closure() != nullptr ? std::vector<Named>() : pose;
  for (auto& [name, value] : motion) {
    value = 0.0;
  }
  for (const auto& [name, value] : start.velocities) {
    double* known = find(motion, name);
    known != nullptr ? void(*known = value) : void(motion.emplace_back(name, value));
  }
  x.segment(n, n) = solve_for(plant, motion, true, x.head(n));
  if (plant.closure() != nullptr) {
    check(plant, motion, x, true);
  }
  if (!lifted) {
    check(plant, pose, x);
  }
  check_charts(plant, x);
  return x;
}

}  // namespace plumbline::run
