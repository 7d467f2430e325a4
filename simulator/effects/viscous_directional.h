// The part of viscous friction that differs between the two directions.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -difference |v|                             [N m or N]
/// With viscous damping b the two directions have b + difference (v > 0) and b - difference (v < 0).
/// Source: Armstrong-Helouvry, Control of Machines with Friction (1991), direction-dependent friction.
class ViscousDirectional final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  void switches(const Motion& m, const double* p, std::vector<double>& g) const override;
};

}  // namespace plumbline::effects
