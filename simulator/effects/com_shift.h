// A centre of mass that is not where it was stated.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// p_BBcm_B + (x, y, z)                            [m], in the frame B of the body
/// Source: Atkeson, An and Hollerbach, Int. J. of Robotics Research 5(3) (1986).
class ComShift final : public StructureLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  StructureChange change(const double* p) const override;
};

}  // namespace plumbline::effects
