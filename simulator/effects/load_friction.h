// Dry friction in proportion to the load that the motor carries.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -coefficient |load| tanh(v / smoothing_speed)   [N m or N]
/// load: torque that the motor delivers, N m or N.
/// The kink at load = 0 is no switch: a held command changes sign only between samples.
/// Source: Hamon, Gautier and Garrec, IROS 2010, pages 6187-6193 (friction that depends on load and
/// velocity).
class LoadFriction final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
