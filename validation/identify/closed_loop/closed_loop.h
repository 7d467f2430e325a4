// A trial simulated with the controllers that ran: the whole record from one start, not in windows.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "validation/identify/predict/windows.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// One controlled motor of a trial. Relative errors are 100 |measured - simulated| / |measured|, Euclidean
/// norms over all samples, so they depend on where the coordinate has its zero.
struct LoopError {
  std::string motor, sensor;
  std::string force_unit;         ///< N m or N
  double position_percent = 0.0;  ///< of what the sensor reads
  double force_percent = 0.0;     ///< of torque gain times command
  /// Root mean square of recorded command minus the controller's equation on the recorded measurement,
  /// command units: how well the controller is known, whatever the model. Without the first samples of its
  /// difference.
  double equation_rms = 0.0;
  /// Factor by which the disturbance's column must be multiplied so that the controller's equation gives the
  /// recorded command best (least squares); 0 where there is no disturbance.
  double disturbance_factor = 0.0;
};

struct ClosedLoop {
  std::string not_available;     ///< the reason; empty: the results hold
  std::vector<LoopError> loops;  ///< one for each controller
  Eigen::MatrixXd readings;      ///< simulated, sensors of the model x samples, SI
  Eigen::MatrixXd commands;      ///< simulated, motors of the model x samples, command units
};

/// Simulates the trial over its whole length from the state that its first samples show (Predictor). Its
/// controllers see the simulated sensors, without quantisation and noise; motors without a controller get
/// their recorded commands. Not available without controllers, without a recorded signal to compare with, and
/// when the simulation fails or runs away.
/// Error measure: A. Janot, M. Gautier, M. Brunot, Data set and reference models of EMPS, 2019.
ClosedLoop closed_loop(const model::Model& model, const Trial& trial, const PredictOptions& options);

}  // namespace plumbline::validation
