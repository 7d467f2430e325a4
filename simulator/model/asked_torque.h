// What an amplifier is asked for, and gives at most.
#pragma once

#include <algorithm>

#include "simulator/model/model.h"

namespace plumbline::model {

/// Torque (or force) per command unit. A constant per ampere or volt beside a command that is a torque
/// already says how that torque was made.
inline double torque_gain(const Motor& motor) {
  const bool commands_force = motor.command_unit == "N m" || motor.command_unit == "N";
  const bool applies =
      motor.torque_constant.value > 0.0 && (!commands_force || motor.torque_constant.unit == "1");
  return applies ? motor.torque_constant.value : 1.0;
}

/// Torque (or force) that a command asks of a motor: gain times command, no more than the motor's
/// torque_limit either way where the model states one.
inline double asked_torque(const Model& model, int motor, double command) {
  const Motor& of = model.motors[static_cast<std::size_t>(motor)];
  const double limit = of.torque_limit.value;
  const double asked = torque_gain(of) * command;
  return limit > 0.0 ? std::clamp(asked, -limit, limit) : asked;
}

}  // namespace plumbline::model
