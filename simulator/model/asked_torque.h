// What an amplifier is asked for, and gives at most.
#pragma once

#include <algorithm>

#include "simulator/model/plant.h"

namespace plumbline::model {

/// Torque (or force) that a command asks of a motor: gain times command, no more than the motor's
/// torque_limit either way where the model states one.
inline double asked_torque(const Plant& plant, int motor, double command) {
  const double limit = plant.model().motors[static_cast<std::size_t>(motor)].torque_limit.value;
  const double asked = plant.torque_gain(motor) * command;
  return limit > 0.0 ? std::clamp(asked, -limit, limit) : asked;
}

}  // namespace plumbline::model
