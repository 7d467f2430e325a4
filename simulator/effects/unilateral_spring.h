// A spring that acts on one side of its rest position only.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -side (stiffness d + preload tanh(d / smoothing_length)) where d > 0, else 0   [N m or N]
/// d = side (x - rest): deflection, rad or m. The preload builds up over the smoothing length, so that a
/// light load can rest against it. Null when stiffness and preload are 0, wherever it rests. Stored energy:
/// stiffness d^2 / 2 + preload smoothing_length ln cosh(d / smoothing_length). Source: Park et al. (2011),
/// equation 28 and Figure 17; Poulakakis and Grizzle, Thumper (unilateral spring).
class UnilateralSpring final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
  void switches(const Motion& m, const double* p, std::vector<double>& g) const override;
};

}  // namespace plumbline::effects
