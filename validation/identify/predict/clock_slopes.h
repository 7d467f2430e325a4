// How a motion changes with the error of its commands' clock.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/model/plant.h"

namespace plumbline::validation {

/// Writes the columns of B, d(rate)/d(parameters), that are parameters of clock laws, for sample k of a
/// record with these commands (motors x samples) and this period, s. With `late` the time by which the
/// command u of a motor is late,
///   d(rate)/dp = d(rate)/du du/d(late) d(late)/dp,
/// the first factor by central differences at the state x under the mean command of the sample, the second
/// that of clocked_command().
void clock_slopes(model::Plant& plant, const Eigen::MatrixXd& commands, Eigen::Index k, double period,
                  const Eigen::VectorXd& x, const Eigen::VectorXd& command,
                  const std::vector<model::ParameterId>& parameters, Eigen::MatrixXd& B);

}  // namespace plumbline::validation
