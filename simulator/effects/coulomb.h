// Coulomb friction: a force of constant level against the motion.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -level tanh(v / smoothing_speed)            [N m or N]
/// Lost power: level |v| above the smoothing speed.
/// Source: Olsson et al., Friction models and friction compensation, European J. of Control 4 (1998).
class Coulomb final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
