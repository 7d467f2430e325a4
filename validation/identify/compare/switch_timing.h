// Whether contact switches read when the model's feet land and lift off.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {

/// Of one contact switch in one trial: instants read less instants predicted, s.
struct SwitchTiming {
  std::string trial, name;
  bool closes = true;  ///< the touchdowns; else the lift-offs
  std::size_t count = 0;
  double mean = 0.0;     ///< above zero where the switch reads later than is predicted
  double scatter = 0.0;  ///< standard deviation from landing to landing
  double floor = 0.0;    ///< what the sampling leaves of one instant

  /// Off by the same each time: more than twice the floor, and than twice the scatter. A ground that is wrong
  /// is off by what each landing makes of it; a switch that is late is late.
  bool is_steady() const;
};

/// With the estimate's initial states, the model as it is. Switches with fewer than three landings are left
/// out.
std::vector<SwitchTiming> switch_timing(PredictorPool& pool, const Estimate& estimate);

}  // namespace plumbline::validation
