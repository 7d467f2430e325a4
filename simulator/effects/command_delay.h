// A command that takes effect later.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// torque(t) = u(t - delay)                        [N m or N], delay in s
/// The delay itself is carried out by whoever holds the command; torque() passes it on.
/// Source: Astrom and Murray, Feedback Systems (2008), time delay.
class CommandDelay : public ActuatorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double torque(double commanded, const double* state, const double* p) const override;
  double delay(const double* p) const override;
};

}  // namespace plumbline::effects
