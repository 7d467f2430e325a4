// A hard stop: a stiff, damped contact beyond a position.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -side (stiffness d + cubic_stiffness d^3 + damping d' + root_damping
///     (sqrt((r + rounding) / root_speed) - sqrt(rounding / root_speed))) where d > 0, else 0   [N m or N]
/// d = side (x - position): penetration, rad or m; d': its rate; r = max(d', 0): the root acts only while
/// moving in. root_speed fixes its unit (1 rad/s: the numbers of Table VIII). Both damping terms jump at d =
/// 0 (switch d); without rounding the root's slope is unbounded at d' = 0 (switch d'), and implicit
/// integrators stall where something comes to rest on the stop. Null when the four coefficients are 0,
/// wherever the stop is. Stored energy: stiffness d^2 / 2 + cubic_stiffness d^4 / 4. Source: Park et al.
/// (2011), equation 28, the branches of the stop, and Table VIII; the linear stiffness (rubber, a plain
/// penalty; 0 there) and the rounding are ours.
class HardStop final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
  double dissipated_power(const Motion& m, const double* state, const double* p) const override;
  void switches(const Motion& m, const double* p, std::vector<double>& g) const override;
  int jumps(const double* p) const override;
};

}  // namespace plumbline::effects
