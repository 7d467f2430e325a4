// A clock of the commands that is not that of the measurements.
#pragma once

#include <vector>

#include "simulator/effects/clock_law.h"

namespace plumbline::effects {

/// torque(t) = u(t - offset - drift (t - t0))      [N m or N], offset in s, drift in s/s (1e-6: 1 ppm)
/// t is the time of the measurements, t0 where the record begins, u(t) what was commanded by its own time
/// stamp. Where the commands' clock runs slow or began early they take effect late: above 0. With drift = 0
/// and offset not below 0 it is a command_delay. A crystal drifts by up to 1e-4, an oscillator without one by
/// some 1e-2; |drift| is at most 0.1. An error of the record: where a controller gives the commands of a
/// simulation there is one clock, and the law does nothing. torque() passes the command on, at its full
/// power; the time is changed by whoever holds it. Null at offset = drift = 0.
/// Source: Lamport, Communications of the ACM 21(7), 1978, condition PC1 (a clock's rate is 1 within kappa);
/// Olson, "A passive solution to the sensor synchronization problem", IEEE/RSJ Int. Conf. Intelligent Robots
/// and Systems (2010), section II (offset and drift of a device's clock).
class ClockDrift final : public ClockLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  ClockError clock(const double* p) const override;
};

}  // namespace plumbline::effects
