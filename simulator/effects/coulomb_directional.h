// The part of Coulomb friction that differs between the two directions.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -difference tanh(v / smoothing_speed)^2     [N m or N]
/// With Coulomb friction of level F the two directions have F + difference (v > 0) and F - difference (v <
/// 0). Source: Armstrong-Helouvry, Control of Machines with Friction (1991), direction-dependent friction.
class CoulombDirectional final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
