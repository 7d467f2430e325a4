// Positions of all independent coordinates from what was measured or recorded of some.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <memory>

#include "simulator/model/plant.h"

namespace plumbline::model {

/// What one channel says of the independent coordinates z: value = row z + offset, give or take `deviation`.
struct Observation {
  Eigen::RowVectorXd row;
  double offset = 0.0;
  double deviation = 1.0;
};

/// A sensor's true position; its deviation is the sensor's floor (1e-9 where that is zero).
Observation observe_sensor(const Plant& plant, int sensor);
/// A joint, coordinate, motor or pulley by name. Throws InputError for an unknown one.
Observation observe_place(const Plant& plant, const std::string& name, double deviation);

/// Weighted least squares: min sum ((row z + offset - value) / deviation)^2. A stretch that no channel sees
/// is zero; what else none sees stays at zero, see determined(). Of a model with loops, among the positions
/// that close them, each sample from the one before; ranks and deviations are those where the loops are
/// closed first.
class PositionsFrom {
 public:
  PositionsFrom(const Plant& plant, const std::vector<Observation>& channels);

  /// False when the channels (and stretches of zero) leave some combination of coordinates open.
  bool determined() const { return solver_.rank() == positions_; }

  /// One standard deviation of each of z as the channels' deviations leave it, wide where a stretch is seen
  /// by none; what none sees: 0.
  Eigen::VectorXd deviations() const;
  /// The same where stretches that no channel sees are zero.
  Eigen::VectorXd deviations_unstretched() const;

  /// z, positions x samples, from values, channels x samples.
  Eigen::MatrixXd positions(const Eigen::MatrixXd& values) const;
  /// dz/dt from the channels' rates at these positions.
  Eigen::MatrixXd rates(const Eigen::MatrixXd& values, const Eigen::MatrixXd& positions) const;

 private:
  Eigen::MatrixXd solve(const Eigen::MatrixXd& weighted) const;
  Eigen::MatrixXd right_side(const Eigen::MatrixXd& weighted) const;

  Eigen::Index positions_, stretches_;
  Eigen::Index loops_ = 0;  // rows that close them
  Eigen::VectorXd offsets_, weights_;
  std::shared_ptr<LoopClosure> closure_;  // null: no loops
  Eigen::MatrixXd rows_;                  // of channels and stretches, where there are loops
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver_;
};

}  // namespace plumbline::model
