// A hard stop: a stiff, damped contact beyond a position.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -side max(push, -pulls |push|) where d > 0, else 0                                      [N m or N]
/// push = stiffness d + cubic_stiffness d^3 + damping d' + root_damping
///        (sqrt((r + rounding) / root_speed) - sqrt(rounding / root_speed))
/// d = side (x - position): penetration, rad or m; d': its rate; r = max(d', 0): the root acts only while
/// moving in. root_speed fixes its unit (1 rad/s: the numbers of Table VIII). pulls = 1 is the paper's form,
/// in which damping holds back what leaves; pulls = 0 a stop that only pushes, what a diagnosis looks for:
/// the surfaces part where push falls to 0 (switch push). Both damping terms jump at d = 0 (switch d);
/// without rounding the root's slope is unbounded at d' = 0 (switch d'), and implicit integrators stall where
/// something comes to rest on the stop. Null when the four coefficients are 0, wherever the stop is. Stored
/// energy: stiffness d^2 / 2 + cubic_stiffness d^4 / 4; what is left of it where the surfaces part is lost in
/// the stop as it springs back. Source: Park et al. (2011), equation 28, the branches of the stop, and Table
/// VIII; the linear stiffness (rubber, a plain penalty; 0 there) and the rounding are ours; that surfaces do
/// not pull is Signorini's condition (Brogliato, Nonsmooth Mechanics, 3rd edition, 2016, section 2.1).
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
