// A spring with one stiffness on either side of its rest position.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -stiffness_above d where d > 0, else -stiffness_below d; d = x - rest    [N m or N]
/// Continuous; its slope jumps at rest. With equal stiffnesses it is `spring`, with one of them 0
/// `unilateral_spring` without a preload. Stored energy: stiffness d^2 / 2 with the stiffness of the side.
/// Source: Shaw and Holmes, A periodically forced piecewise linear oscillator, J. Sound and Vibration 90(1)
/// (1983), equation 1.
class AsymmetricSpring final : public ForceLaw {
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
