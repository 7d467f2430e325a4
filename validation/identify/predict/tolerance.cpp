#include "validation/identify/predict/tolerance.h"

#include <algorithm>

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

}  // namespace

Eigen::VectorXd tolerances_of(model::Plant& plant, const std::vector<FlooredSensor>& channels,
                              const Eigen::VectorXd& x, const double* command, double length) {
  const Eigen::MatrixXd slopes = slopes_of(plant, x, command);
  const Eigen::Index nz = plant.positions();
  Eigen::VectorXd seen = Eigen::VectorXd::Zero(x.size());  // floors for one unit
  for (const FlooredSensor& channel : channels) {
    seen = seen.cwiseMax(slopes.row(channel.sensor).cwiseAbs().transpose() / channel.floor);
  }
  seen.segment(nz, nz) = seen.segment(nz, nz).cwiseMax(length * seen.head(nz));
  const double least = 1e-2 * kRelativeTolerance;
  Eigen::VectorXd tolerances(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    tolerances[i] = seen[i] > 0.0 ? std::max(least, kShareOfFloor / seen[i]) : least;
  }
  return tolerances;
}

}  // namespace plumbline::validation
