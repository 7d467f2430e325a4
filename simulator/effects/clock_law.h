// A command that takes effect at another time than its record says.
#pragma once

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// How the clock of a record's commands differs from that of its measurements: a command takes effect
/// offset + drift (t - t0) later than the record says, t0 where the record begins.
struct ClockError {
  double offset = 0.0;  ///< s; negative: earlier
  double drift = 0.0;   ///< s/s
};

/// An error of recorded time stamps. The command itself is passed on; whoever reads the record looks it up at
/// another time. A controller in a simulation gives its commands when they are needed: there is no second
/// clock, and the law does nothing.
class ClockLaw : public ActuatorLaw {
 public:
  virtual ClockError clock(const double* p) const = 0;
  double torque(double commanded, const double* /*state*/, const double* /*p*/) const final {
    return commanded;
  }
};

}  // namespace plumbline::effects
