// Positions of all independent coordinates from what was measured or recorded of some.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <memory>

#include "simulator/model/plant.h"

namespace plumbline::model {

/// What one channel says of the independent coordinates z: value = row z + offset, give or take `deviation`.
/// Of a marker or an orientation that holds near z = 0 only, and `sensor` is one of the plant's sensors.
struct Observation {
  Eigen::RowVectorXd row;
  double offset = 0.0;
  double deviation = 1.0;
  int sensor = -1;
};

/// A sensor's true position, or the pose that it shows (shows_pose); its deviation is the sensor's floor
/// (1e-9 where that is zero). The three components of an orientation stand one behind the other.
Observation observe_sensor(const Plant& plant, int sensor);
/// A joint, coordinate, motor or pulley by name. Throws InputError for an unknown one.
Observation observe_place(const Plant& plant, const std::string& name, double deviation);

/// How markers and orientations change with the positions (positions_from.cpp).
class PoseRows;

/// Weighted least squares: min sum ((row z + offset - value) / deviation)^2. A stretch that no channel sees
/// is zero; what else none sees stays at zero, see determined(). Of a model with loops, among the positions
/// that close them, each sample from the one before; ranks and deviations are those where the loops are
/// closed first. Markers and orientations are seen by Gauss and Newton's method, each sample from the one
/// before: an orientation's residual is the rotation vector of what is measured as seen from z.
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
  /// dz/dt from the channels' rates at these positions, where the channels have these values.
  Eigen::MatrixXd rates(const Eigen::MatrixXd& rates, const Eigen::MatrixXd& positions,
                        const Eigen::MatrixXd& values) const;

 private:
  Eigen::MatrixXd solve(const Eigen::MatrixXd& weighted) const;
  Eigen::MatrixXd right_side(const Eigen::MatrixXd& weighted) const;
  Eigen::VectorXd pose_at(const Eigen::VectorXd& values, Eigen::VectorXd z) const;

  Eigen::Index positions_, stretches_;
  Eigen::Index loops_ = 0;  // rows that close them
  Eigen::VectorXd offsets_, weights_;
  std::shared_ptr<LoopClosure> closure_;  // null: no loops
  std::shared_ptr<PoseRows> poses_;       // null: no markers or orientations
  Eigen::MatrixXd rows_;                  // of channels and stretches, where there are loops or poses
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver_;
};

}  // namespace plumbline::model
