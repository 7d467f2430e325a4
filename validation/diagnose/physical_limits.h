// What the constants of a physical robot can be, whatever a fit would like.
#pragma once

#include <Eigen/Geometry>

#include "validation/predict/windows.h"

namespace plumbline::validation {

/// Where the material of a link lies, in the link's frame, m: the box around its own joint, the joints that
/// it carries, and the homogeneous cuboid with the link's mass and inertia, whose half lengths are
///   a_i^2 = 3/2 (I_j + I_k - I_i) / m,  I the moments about the frame's axes at the centre of mass.
/// Source of the last: the moments m (b^2 + c^2) / 3 of a cuboid, solved for its half lengths.
Eigen::AlignedBox3d link_box(const model::Skeleton& skeleton, int body);

/// Narrows the bounds of one parameter of an effect that changes the robot's constants, and marks it as one
/// whose bounds are physical:
///   com_shift: the centre of mass stays in link_box();
///   payload: it hangs no farther outside link_box() than the robot's largest link is long (the diagonal of
///   its
///     box), since a hand, a tool or a weight is no longer than a link;
///   added_mass, rotor_inertia, torque_constant_error: a tenth of what is stated is always there.
/// The value that stands in `use` stays allowed. Other parameters are left as they are.
void keep_physical(const model::Model& model, const model::EffectUse& use, FreeParameter& parameter);

}  // namespace plumbline::validation
