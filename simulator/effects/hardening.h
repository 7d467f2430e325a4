// The cubic part of a spring that hardens (or softens).
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -cubic_stiffness (x - rest)^3               [N m or N]
/// Stored energy: cubic_stiffness (x - rest)^4 / 4.
/// Source: Kovacic and Brennan, The Duffing Equation (2011).
class Hardening final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
