// Viscous friction: a force in proportion to the velocity.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -damping v                                  [N m or N]
/// v: velocity, rad/s or m/s. Lost power: damping v^2.
/// Source: Park, Sreenath, Hurst and Grizzle (2011), equations 8 and 16.
class Viscous final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
