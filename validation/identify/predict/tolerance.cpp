#include "validation/identify/predict/tolerance.h"

#include <algorithm>
#include <unsupported/Eigen/MatrixFunctions>

namespace plumbline::validation {
namespace {

constexpr double kShareOfFloor = 0.03;  // the squares add: half a thousandth of an error at the floor

/// d(reading)/dx of all sensors, sensors x states. Accelerations with the slopes that implicit integrators
/// take, which are right to some percent.
Eigen::MatrixXd slopes_of(model::Plant& plant, const Eigen::VectorXd& x, const double* command) {
  const Eigen::Index nz = plant.positions();
  Eigen::MatrixXd C;
  plant.output_jacobian(x.data(), C, command);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(C.rows(), plant.states());
  slopes.leftCols(C.cols()) = C;
  if (plant.model().has(model::PointReading::accelerometer)) {
    Eigen::MatrixXd A(plant.states(), plant.states());
    plant.stiff_jacobian(x.data(), command, A);
    slopes += plant.acceleration_map(x.data()) * A.middleRows(nz, nz);
  }
  return slopes;
}

/// exp(A' t), from one unit of a hidden state on, A' the slopes of the rates without what the motion does to
/// forces and hidden states: a deviation coasts. `seen` is raised to the largest of |W exp(A' t)| over t.
void see_through_motion(model::Plant& plant, const Eigen::MatrixXd& W, const Eigen::VectorXd& x,
                        const double* command, double length, Eigen::VectorXd& seen) {
  constexpr int kDoublings = 6;
  const Eigen::Index nz = plant.positions();
  const Eigen::Index hidden = x.size() - 2 * nz;
  Eigen::MatrixXd A(x.size(), x.size());
  plant.stiff_jacobian(x.data(), command, A);
  A.block(nz, 0, nz, 2 * nz).setZero();
  A.block(2 * nz, 0, hidden, 2 * nz).setZero();
  Eigen::MatrixXd carried = (A * (length / (1 << kDoublings))).exp();
  for (int i = 0; i <= kDoublings; ++i) {
    seen.tail(hidden) = seen.tail(hidden).cwiseMax(
        (W * carried).rightCols(hidden).cwiseAbs().colwise().maxCoeff().transpose());
    carried = carried * carried;
  }
}

}  // namespace

Eigen::VectorXd tolerances_of(model::Plant& plant, const std::vector<FlooredSensor>& channels,
                              const Eigen::VectorXd& x, const double* command, double length) {
  const Eigen::MatrixXd slopes = slopes_of(plant, x, command);
  const Eigen::Index nz = plant.positions();
  Eigen::MatrixXd W(static_cast<Eigen::Index>(channels.size()), x.size());  // floors for one unit
  for (Eigen::Index c = 0; c < W.rows(); ++c) {
    const FlooredSensor& channel = channels[static_cast<std::size_t>(c)];
    W.row(c) = slopes.row(channel.sensor) / channel.floor;
  }
  Eigen::VectorXd seen = Eigen::VectorXd::Zero(x.size());
  if (W.rows() > 0) {
    seen = W.cwiseAbs().colwise().maxCoeff().transpose();
  }
  seen.segment(nz, nz) = seen.segment(nz, nz).cwiseMax(length * seen.head(nz));
  if (W.rows() > 0 && x.size() > 2 * nz) {
    see_through_motion(plant, W, x, command, length, seen);
  }
  const double least = 1e-2 * kRelativeTolerance;
  Eigen::VectorXd tolerances(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    tolerances[i] = seen[i] > 0.0 ? std::max(least, kShareOfFloor / seen[i]) : least;
  }
  return tolerances;
}

}  // namespace plumbline::validation
