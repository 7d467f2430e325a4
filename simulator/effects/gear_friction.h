// Dry friction of a gear in proportion to what it passes on.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -coefficient |load| tanh(v / smoothing_speed)   [N m or N]
/// load: torque that the motor's gear passes on to what it drives: what acts on the motor, this friction
/// included, less what turns the motor itself. A motor that spins up a light load has a large torque and a
/// small load; under a heavy link it is the other way round. Source: Dohring, Lee and Newman, A
/// load-dependent transmission friction model: theory and experiments, IEEE ICRA 1993.
class GearFriction final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  bool feels_gear_load() const override { return true; }
};

}  // namespace plumbline::effects
