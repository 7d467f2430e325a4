// A channel that shows what was a little earlier: a filter, a bus, another clock.
#pragma once

#include <vector>

#include "simulator/effects/late_sensor_law.h"

namespace plumbline::effects {

/// reading = actual - lag actual_rate                                   [rad or m]
/// To first order in the lag, what a low-pass filter of group delay `lag` shows, or a channel that is sampled
/// so much earlier than the others: the error is lag^2/2 times the acceleration. Below 0 the channel is ahead
/// of the others. All channels late alike are a bus_delay of all motors. Null when lag = 0.
/// Source: Oppenheim and Schafer, Discrete-Time Signal Processing (3rd edition, 2010), section 5.1.1 (group
/// delay).
class SensorLag final : public LateSensorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double lag(const double* p) const override;
};

}  // namespace plumbline::effects
