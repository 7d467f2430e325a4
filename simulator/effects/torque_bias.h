// A constant offset of the torque, as amplifiers have it.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// torque = u + bias                               [N m or N]
/// u: command in torque units.
/// Source: Park et al. (2011), Sidebar 1 and Table VII.
class TorqueBias final : public ActuatorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double torque(double commanded, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
