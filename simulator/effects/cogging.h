// Cogging: a torque that repeats with the motor's angle.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -(sine sin(N x) + cosine cos(N x)), N = cycles   [N m or N]
/// Stored energy: (cosine sin(N x) - sine cos(N x)) / N.  One turn is 2 pi of the motor's position.
/// Source: Holtz and Springob, IEEE Trans. Industrial Electronics 43 (1996), pages 309-320.
class Cogging final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
