// How hard a foot strikes: the impulse of a rigid impact at the state just before a touchdown.
#pragma once

#include <Eigen/Core>

#include "simulator/model/rigid_contact.h"
#include "validation/studies/walking/rigid_gait.h"

namespace plumbline::validation {

/// The impact map of a design model (rigid_gait.h), evaluated at states of another model of the same robot:
/// the joints' positions and rates are carried over, cables are taken as rigid. The foot that comes down
/// stops, the old stance leg's spring keeps its length, the old stance foot leaves without a force. Source:
/// Sreenath et al. (2011), equations 16 to 18; as the contact intensity: Park, Ramezani, Grizzle, ICRA 2012,
/// section II.
class ContactIntensity {
 public:
  explicit ContactIntensity(const RigidGait& design);

  /// Impulse of the ground on the foot, N s. `plant` at `x`: just before the touchdown; the foot is named as
  /// in the design model. Throws InputError where the plant has none of the design model's coordinates, and
  /// for a foot that is neither leg's.
  Eigen::Vector3d of(const model::Plant& plant, const Eigen::VectorXd& x, const std::string& foot);

 private:
  const RigidGait& design_;
  model::Plant plant_;
  model::RigidContact contact_;
  std::vector<std::string> names_;  // carried over
};

}  // namespace plumbline::validation
