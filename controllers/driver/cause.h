// Why the driver has stopped a robot.
#pragma once

#include <cstdint>

namespace plumbline::driver {

enum class Cause : std::uint8_t {
  none,
  not_a_number,         ///< in a sensor's value or a command
  command_limit,        ///< a command beyond its largest magnitude
  slew_limit,           ///< a command that changes too quickly
  stopping_position,    ///< it would not come to rest within its limits any more
  workspace,            ///< outside its limits
  count_jump,           ///< a sensor that moved faster than the robot can
  frozen_sensor,        ///< a sensor that does not change for too long
  stale,                ///< no packet from the robot for too long
  lost,                 ///< too many packets missing
  duplicated,           ///< too many packets twice
  reordered,            ///< too many packets behind newer ones
  corrupt,              ///< too many packets whose CRC, size or values are wrong
  wrong_layout,         ///< the robot has other channels or commands than the certificate
  late_cycle,           ///< commands too long after their sample, too often
  controller_overrun,   ///< the controller had not answered in time
  controller_crash,     ///< the controller's process has ended
  controller_gave_up,   ///< step() returned a fault
  emergency_stop,       ///< a button of the robot, the operator, or a signal
  power_cut,            ///< the robot's side has switched its motors off
  expired_certificate,  ///< its last day is over
};
constexpr int kCauses = 21;

/// "not a number", "command limit", ...
const char* to_string(Cause cause) noexcept;

}  // namespace plumbline::driver
