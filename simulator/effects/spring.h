// A linear spring.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -stiffness (x - rest)                       [N m or N]
/// Stored energy: stiffness (x - rest)^2 / 2.
/// Source: Park et al. (2011), equation 28 (term K_B).
class Spring final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
