// A contact switch that closes or opens late, or early.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// closing = touchdown + closes_late, opening = lift_off + opens_late   [s]
/// Below zero is early: a switch that a force holds closed opens before the foot has left the ground.
/// Assumed: constant. The time that a spring in the switch takes depends on how fast the foot loads it, which
/// a constant stands for as long as the landings are alike. Source: Hausdorff, Ladin and Wei, J. Biomechanics
/// 28 (1995), pages 347-351 (constant delays of footswitches against a force plate).
class SwitchLateness final : public SwitchLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double lateness(bool closes, const double* p) const override;
};

}  // namespace plumbline::effects
