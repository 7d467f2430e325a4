// Hysteretic damping: a loss in each cycle that does not depend on frequency.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -loss |x - rest| tanh(v / smoothing_speed)  [N m or N]
/// A cycle of amplitude X around rest loses 2 loss X^2.
/// Source: Reid, Free vibration and hysteretic damping, J. Royal Aeronautical Society 60 (1956).
class Hysteresis final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  void switches(const Motion& m, const double* p, std::vector<double>& g) const override;
};

}  // namespace plumbline::effects
