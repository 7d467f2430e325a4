// A constant force.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -preload                                    [N m or N]
/// Stored energy: preload x (zero at x = 0).
/// Source: Park et al. (2011), Figure 17 (springs fitted with a preload).
class Preload final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
