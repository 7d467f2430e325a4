// A torque constant that differs from the stated one.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// torque = scale u                                [N m or N]
/// u: command in torque units; null at scale = 1.
/// Source: Park et al. (2011), correction factor alpha_torque of Table V.
class TorqueConstantError final : public ActuatorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double torque(double commanded, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
