// An actuator that follows its command as a first-order lag.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// torque = s,  ds/dt = (u - s) / time_constant    [N m or N], s: state "delivered"
/// Null when time_constant = 0: torque = u.
/// Source: Astrom and Murray, Feedback Systems (2008), first-order systems.
class ActuatorLag final : public ActuatorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double torque(double commanded, const double* state, const double* p) const override;
  void state_rate(double commanded, const double* state, const double* p, double* rate) const override;
  void settle(double commanded, const double* p, double* state) const override;
};

}  // namespace plumbline::effects
