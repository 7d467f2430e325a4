#include "validation/identify/trial/computed_command.h"

#include <algorithm>

namespace plumbline::validation {
namespace {

Eigen::VectorXd differences(const Eigen::VectorXd& values, const Eigen::VectorXd& time, Eigen::Index over) {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index k = over; k < values.size(); ++k) {
    rate[k] = (values[k] - values[k - over]) / (time[k] - time[k - over]);
  }
  return rate;
}

}  // namespace

Eigen::VectorXd computed_command(const Controller& c, const ControllerSignals& signals) {
  const Eigen::VectorXd velocity = signals.velocity.size() > 0
                                       ? signals.velocity
                                       : differences(signals.measured, signals.time, c.velocity_over);
  const Eigen::VectorXd error = c.reference - signals.measured;
  Eigen::VectorXd command;
  if (c.kind == "pd") {
    command = c.position_gain * error - c.velocity_gain * velocity;
    if (signals.reference_velocity.size() > 0) {
      command += c.velocity_gain * signals.reference_velocity;
    }
  } else {
    command = c.velocity_gain * (c.position_gain * error - velocity);
  }
  if (c.disturbance.size() > 0) {
    command += c.disturbance;
  }
  if (c.command_limit > 0.0) {
    command = command.cwiseMax(-c.command_limit).cwiseMin(c.command_limit);
  }
  return command;
}

std::string law_of_command(const Controller& c) {
  return "computed by " + c.kind + " from " + c.sensor + " and its reference";
}

}  // namespace plumbline::validation
