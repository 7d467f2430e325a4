// A torque constant that sags with the current.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// torque = u / sqrt(1 + sag u^2)                  [N m or N]
/// u: command in torque units; sag: 1/(N m)^2 or 1/N^2. Small commands pass as they are, large ones come near
/// 1/sqrt(sag), where the iron is saturated; at u = 1/sqrt(sag) the motor gives 71 % of what it is asked for.
/// Source: Fitzgerald, Kingsley and Umans, Electric Machinery (6th edition, 2003), section 1.3 (magnetisation
/// curves: linear, knee, saturation); the smooth curve between the two straight parts is the usual fit.
class TorqueSaturation final : public ActuatorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double torque(double commanded, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
