// The command of a position-controlled drive that was not recorded, from its law.
#pragma once

#include <Eigen/Core>
#include <string>

#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// What a controller read and was told, row by row, SI; empty: not recorded.
struct ControllerSignals {
  Eigen::VectorXd time, measured;
  Eigen::VectorXd velocity;            ///< else the measurement's difference over velocity_over rows
  Eigen::VectorXd reference_velocity;  ///< else zero
};

/// The law of trial.h (Controller), cut at its limit. The controller saw the same measurement that the log
/// has, so that its quantisation is in the command as it was on the robot.
Eigen::VectorXd computed_command(const Controller& controller, const ControllerSignals& signals);

/// "computed by pd from position and its reference"
std::string law_of_command(const Controller& controller);

}  // namespace plumbline::validation
