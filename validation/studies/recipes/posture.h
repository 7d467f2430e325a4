// Static equilibria of a model whose motors are held and which a hand balances.
#pragma once

#include <Eigen/Core>

#include "simulator/model/plant.h"
#include "validation/studies/recipes/recipe.h"

namespace plumbline::validation {

struct PostureReadings {
  Eigen::MatrixXd sensors;  ///< sensors x poses, SI
  Eigen::VectorXd weight;   ///< on the scale, N; empty without one
};

/// Weight of all links that move and of what effects add to them, N.
double total_weight(const model::Model& model);

/// One pose: the plant with its locks, and the equilibrium that it finds.
class Posture {
 public:
  /// `held`: value of each of the postures' locked places. `offset`: how far the balanced coordinate stands
  /// beside its equilibrium; it is held there, and all else finds its own.
  Posture(const model::Model& model, const Postures& postures, const Postures::Pose& pose,
          const std::vector<double>& held);

  /// True readings of all sensors. Throws std::runtime_error when there is no equilibrium near the pose.
  Eigen::VectorXd readings(double offset = 0.0);
  model::Plant& plant() { return plant_; }

 private:
  Eigen::VectorXd balance(model::Plant& plant, const Eigen::VectorXd& near);
  Eigen::VectorXd start_of(model::Plant& plant) const;

  const Postures& postures_;
  const Postures::Pose& pose_;
  std::vector<model::Lock> locks_;
  model::Plant plant_;
};

/// What the pose's coordinates, with no cable stretched, give each locked place.
std::vector<double> held_by_pose(const model::Model& model, const Postures& postures,
                                 const Postures::Pose& pose);

/// The same as the sensors of the locked places read it.
std::vector<double> held_by_readings(const model::Model& model, const Postures& postures,
                                     const Eigen::VectorXd& readings);

}  // namespace plumbline::validation
