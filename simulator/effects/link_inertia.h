// An inertia tensor that is not what was stated.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// The matter of a body is stretched and sheared about its centre of mass by
///   F = [e^a 0 0; h_xy e^b 0; h_xz h_yz e^c]                         [1], along the axes of the body's frame
/// with its mass and centre of mass where they were. Of S, the second moments of its matter:
///   S = tr(I)/2 1 - I,   S' = F S F^T,   I' = tr(S') 1 - S'          about the centre of mass [kg m^2]
/// Every value leaves S' positive semidefinite, so that the tensor remains one that a body can have, and
/// every such tensor is reached once (Cholesky). Source: Wensing, Kim and Slotine, Linear matrix inequalities
/// for physically consistent inertial parameter identification, IEEE Robotics and Automation Letters 3(1)
/// (2018); Rucker and Wensing, Smooth parameterization of rigid-body inertia, IEEE Robotics and Automation
/// Letters 7(2) (2022), of which this is the part about the centre of mass.
class LinkInertia final : public StructureLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  StructureChange change(const double* p) const override;
};

}  // namespace plumbline::effects
