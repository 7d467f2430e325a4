// A current loop of second order: it overshoots, or rounds a step off.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// torque = delivered                               [N m or N], states "delivered" and its rate "slope"
/// d delivered/dt = slope
/// d slope/dt     = w (w (u - delivered) - 2 damping_ratio slope),  w = 1/time_constant
/// Null when time_constant = 0: torque = u. Winding and integrator of the current controller are its two
/// states; well tuned, damping_ratio is 0.7 to 1.
/// Source: Astrom and Murray, Feedback Systems (2008), section 6.3 (second-order systems).
class CurrentLoop final : public ActuatorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double torque(double commanded, const double* state, const double* p) const override;
  void state_rate(double commanded, const double* state, const double* p, double* rate) const override;
  void settle(double commanded, const double* p, double* state) const override;
};

}  // namespace plumbline::effects
