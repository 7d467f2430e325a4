// What the driver has to know of a robot and its controller: the signed part of a certificate.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "controllers/driver/json.h"

namespace plumbline::driver {

constexpr double kNone = std::numeric_limits<double>::infinity();

enum class ChannelKind { count, contact, value };

/// One number of a robot's packet.
struct Channel {
  std::string name;
  std::string unit;  ///< of count times scale, or of the value
  ChannelKind kind = ChannelKind::count;
  double scale = 1.0;    ///< unit per count; 1 for other kinds
  double speed = kNone;  ///< largest magnitude of its rate, unit/s; beyond: a jump
  double rest = kNone;   ///< longest time without any change while the controller runs, s
};

/// Keeps one motor where it is while the robot is being held: torque = -stiffness (q - q0) - damping dq/dt,
/// q0 as found when the driver was armed.
struct Hold {
  int channel = -1;  ///< -1: commands 0
  double stiffness = 0.0, damping = 0.0;
};

/// One number of a driver's packet.
struct CommandChannel {
  std::string name;
  std::string unit;
  double limit = 0.0;   ///< largest magnitude
  double slew = kNone;  ///< largest magnitude of its change, unit/s
  Hold hold;
};

/// A weighted sum of channels, unit times factor each, that stays within limits.
struct Reach {
  struct Term {
    int channel = 0;
    double factor = 1.0;
  };
  std::string name;
  std::vector<Term> of;
  double from = -kNone, to = kNone;
  /// At which it comes to rest without torque, unit/s^2; the position at which it would is held to the same
  /// limits. Infinite: no prediction.
  double deceleration = kNone;
};

/// How many packets may go wrong before that is a fault.
struct PacketTolerance {
  int lost_in_succession = 0;
  int lost = 0, duplicated = 0, reordered = 0, corrupt = 0;  ///< among the newest 1000 packets
};

struct Plan {
  std::string title, robot;
  std::string model;     ///< file of the certificate
  double period = 1e-3;  ///< s
  std::vector<Channel> channels;
  std::vector<CommandChannel> commands;

  std::string library;  ///< file of the certificate
  std::string library_sha256;
  std::string controller, controller_version;
  std::vector<std::string> constant_names;
  std::vector<double> constants;
  struct Input {
    std::string port;
    std::vector<int> from;  ///< one channel, or several contacts of which any closes the port; none: fixed
    double scale = 1.0;     ///< that the controller is told: unit per count
    double fixed = 0.0;     ///< what it is given when no channel is
  };
  std::vector<Input> inputs;
  struct Output {
    std::string port;
    int to = 0;
  };
  std::vector<Output> outputs;
  std::vector<std::string> log;  ///< the controller's own log

  std::vector<Reach> workspace;
  std::vector<Reach> handover;  ///< posture from which the controller may take over
  PacketTolerance packets;
  double silence = 0.0;          ///< s without a packet that is a fault
  double answer = 0.0;           ///< s from a sample's arrival to the command that are too late
  int late = 0;                  ///< cycles among the newest 1000 that may be late
  double controller_time = 0.0;  ///< s within which the controller must have answered

  std::vector<std::string> channel_names() const;
  std::vector<std::string> command_names() const;
};

/// From a certificate's body. Throws DriverError naming the member that is missing, unknown or out of range.
Plan plan_from(const Json& body);

}  // namespace plumbline::driver
