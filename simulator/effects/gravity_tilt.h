// A base that is not level: gravity turned in the world frame.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// gravity turned by the rotation vector (roll, pitch, 0)   [rad], about the world's x and y
/// Source: Featherstone, Rigid Body Dynamics Algorithms (2008).
class GravityTilt final : public StructureLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  StructureChange change(const double* p) const override;
};

}  // namespace plumbline::effects
