// Inertia at a motor beyond the stated one.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// inertia of the motor + inertia                  [kg m^2 or kg]
/// The total must stay positive; only the model knows it.
/// Source: Park et al. (2011), correction factor alpha_rotor of Table V.
class RotorInertia final : public StructureLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  StructureChange change(const double* p) const override;
};

}  // namespace plumbline::effects
