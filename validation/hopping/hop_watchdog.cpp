#include "validation/hopping/hop_watchdog.h"

#include <fmt/core.h>

#include <cmath>

namespace plumbline::validation {
namespace {

constexpr double kLowestHip = -0.5;     // m, against a level boom at 1 m
constexpr double kLargestTorso = 1.0;   // rad
constexpr double kLongestPhase = 1.5;   // s
constexpr double kLongestStand = 2.0;   // s
constexpr double kAfterPowerOff = 3.0;  // s; a robot without power lies by then

}  // namespace

std::string HopWatchdog::look(const HopSimulation& simulation) {
  const double now = simulation.time();
  bool down = false;
  for (const model::Touch& touch : simulation.touches()) {
    down = down || touch.depth > 0.0;
  }
  flown_ = flown_ || (stood_ && !down);
  stood_ = stood_ || down;
  last_flight_ = down ? last_flight_ : now;
  const controllers::StopSwitch stop = simulation.loop().controller().power_off();
  if (stop != controllers::StopSwitch::none && power_off_since_ < 0.0) {
    power_off_since_ = now;
  }
  std::string end = reason(simulation);
  if (end.empty() || power_off_since_ < 0.0) {
    return end;
  }
  return fmt::format("a hard stop's switch closed at {:.3f} s ({}), power off; {}", power_off_since_,
                     to_string(stop), end);
}

std::string HopWatchdog::reason(const HopSimulation& simulation) const {
  const Eigen::VectorXd& y = simulation.outputs();
  const double now = simulation.time();
  const controllers::Hopping& controller = simulation.loop().controller();
  if (!y.allFinite()) {
    return fmt::format("the state is not finite at {:.3f} s", now);
  }
  if (watch_.height(y) < kLowestHip) {
    return fmt::format("fell at {:.3f} s: the hip is down", now);
  }
  if (std::abs(watch_.torso(y)) > kLargestTorso) {
    return fmt::format("fell {} at {:.3f} s: the torso has turned over",
                       watch_.torso(y) > 0.0 ? "backward" : "forward", now);
  }
  if (power_off_since_ >= 0.0) {
    return now - power_off_since_ > kAfterPowerOff ? "lies" : "";
  }
  if (now - last_flight_ > kLongestStand) {
    return fmt::format("{} the ground, on it since {:.3f} s", flown_ ? "does not leave" : "never leaves",
                       last_flight_);
  }
  if (controller.time_in_phase() > kLongestPhase) {
    return fmt::format("stays in phase {} at {:.3f} s", to_string(controller.phase()), now);
  }
  return "";
}

}  // namespace plumbline::validation
