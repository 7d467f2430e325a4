// How a force plate's readings depend on where a window begins and on the parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/model/plant.h"

namespace plumbline::validation {

/// d(vertical force)/d(initial state, parameters) of every sensor that is a plate, in N; zero rows for the
/// others. At one instant, with S = d(state)/d(initial state, parameters),
///   dF/dx S + dF/dp,
/// both by differences of the plates' forces, no dynamics. The mean over a sample (see
/// integrate::PlateMeans) is that of its pieces, each with dF at the piece's middle state and the mean of S
/// over it: where the ground is stiff the two parts nearly cancel, which they do only if both come from one
/// linearisation. The last columns of S belong to the parameters.
class PlateSlopes {
 public:
  PlateSlopes(model::Plant& plant, std::vector<model::ParameterId> parameters, Eigen::VectorXd steps);

  bool any() const { return any_; }
  Eigen::MatrixXd at(const Eigen::VectorXd& x, const Eigen::MatrixXd& S);
  void begin();
  void add(double length, const Eigen::VectorXd& middle, const Eigen::MatrixXd& mean_S);
  /// Over what was added since begin().
  Eigen::MatrixXd mean() const { return impulse_ / time_; }

 private:
  Eigen::VectorXd forces(const Eigen::VectorXd& x);
  Eigen::VectorXd by_parameter(std::size_t p, const Eigen::VectorXd& x);

  model::Plant& plant_;
  std::vector<model::ParameterId> parameters_;
  Eigen::VectorXd steps_;
  bool any_;
  double time_ = 0.0;
  Eigen::MatrixXd impulse_;
};

}  // namespace plumbline::validation
