// Backlash: play in a ratio, with a damped stiff contact on either side.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -sgn(e) max(0, stiffness |e| + damping sgn(e) v)     [N m or N]
/// e: what the stretch x exceeds the half gap by (0 inside the gap), rad or m.
/// The surfaces push but never pull; the damping jumps when they touch. Stored energy: stiffness e^2 / 2.
/// Null when gap = 0: the ratio is then rigid.
/// Source: Nordin and Gutman, Controlling mechanical systems with backlash, Automatica 38 (2002).
class Backlash final : public ForceLaw {
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
