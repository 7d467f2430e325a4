// Cable stretch: a damped spring in a ratio that was rigid.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -(stiffness x + damping v)                  [N m or N]
/// x: stretch of the ratio, c(q) of Park et al. equation 23, rad or m of the motor; v: its rate.
/// Null when stiffness is infinite: the ratio is then rigid, whatever the damping is.
/// Source: Park et al. (2011), equations 23 to 25; the minus sign, which equation 25 leaves out, restores.
class CableStretch final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
  double dissipated_power(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
