// Looks at a hopping run sample by sample and says when it is over, and why.
#pragma once

#include <string>

#include "validation/hopping/hip_watch.h"
#include "validation/hopping/hop_simulation.h"

namespace plumbline::validation {

/// The robot has fallen when its hip is 0.5 m below a level boom or its torso has turned by more than 1 rad.
/// The run is over too when the controller stays in one phase for longer than 1.5 s, or when the feet have
/// not both been off the ground for 2 s.
class HopWatchdog {
 public:
  explicit HopWatchdog(const HipWatch& watch) : watch_(watch) {}

  /// Empty while the run may go on; otherwise the reason, with its time.
  std::string look(const HopSimulation& simulation);

 private:
  std::string reason(const HopSimulation& simulation) const;

  const HipWatch& watch_;
  double last_flight_ = 0.0;
  bool stood_ = false;           // has been on the ground
  bool flown_ = false;           // has left it after that
  double power_off_since_ = -1;  // s
};

}  // namespace plumbline::validation
