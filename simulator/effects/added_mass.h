// Mass of a body beyond the stated one, at its centre of mass.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// mass of the body + mass                         [kg]
/// The total must stay positive; only the model knows it.
/// Source: Atkeson, An and Hollerbach, Int. J. of Robotics Research 5(3) (1986).
class AddedMass final : public StructureLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  StructureChange change(const double* p) const override;
};

}  // namespace plumbline::effects
