// An encoder that turns faster than its counter can follow.
#pragma once

#include <vector>

#include "simulator/effects/losing_sensor_law.h"

namespace plumbline::effects {

/// reading     = actual + lost                                                                [rad or m]
/// d(lost)/dt  = -share v (1 + tanh((|v| - limit_speed)/(width limit_speed)))/2               [rad/s or m/s]
/// lost [rad or m]: the state, what is missing in the count so far, 0 where the record begins; v: true speed.
/// share [1], 0 to 2: how many of the counts above limit_speed are missed; at 1 none is counted, at 2 the
/// decoder takes the edges for those of the other direction. limit_speed [rad/s or m/s], above 0: up to which
/// every count is seen. width [1], fixed: the range of speeds over which it begins, over the limit, for edges
/// are not evenly spaced. What was lost stays lost, until an index or a restart sets the zero again. An ideal
/// decoder that samples an encoder of N edges a turn at f Hz has limit_speed = 2 pi f/N.
/// Null when share = 0. Source: de Silva, Sensors and Actuators (2nd edition, 2015), chapter 11 (digital
/// transducers: speed limit of incremental encoders); the share is ours.
class LostCounts final : public LosingSensorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double loss_rate(double actual_rate, const double* p) const override;
};

}  // namespace plumbline::effects
