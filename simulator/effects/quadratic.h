// Drag in proportion to the square of the velocity.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -drag |v| v                                 [N m or N]
/// Once continuously differentiable at v = 0.
/// Source: Batchelor, An Introduction to Fluid Dynamics (1967): drag at high Reynolds number.
class Quadratic final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
