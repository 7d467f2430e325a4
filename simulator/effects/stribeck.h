// Coulomb friction that is higher at low speed.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -(level + rise exp(-(v / stribeck_speed)^2)) tanh(v / smoothing_speed)   [N m or N]
/// Contains Coulomb friction (rise = 0). Null when level and rise are 0, whatever the speeds are.
/// Source: Bo and Pavelescu, Wear 82 (1982); Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30
/// (1994).
class Stribeck final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
