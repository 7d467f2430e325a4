// Something that hangs on a body: a tool, a battery, a weight.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// A point mass m at r = (x, y, z) in the frame B of the body, which has mass M, centre of mass c and inertia
/// I about c. Of body and payload together:
///   M' = M + m                                                             [kg]
///   c' = (M c + m r) / M'                                                  [m]
///   I' = I + M m / M' (|r - c|^2 1 - (r - c)(r - c)^T)   about c'          [kg m^2]
/// Range: m >= 0. At m = 0 nothing changes, wherever r is.
/// Source: Atkeson, An and Hollerbach, Int. J. of Robotics Research 5(3) (1986); the inertia by the theorem
/// of parallel axes for two bodies.
class Payload final : public StructureLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  StructureChange change(const double* p) const override;
};

}  // namespace plumbline::effects
