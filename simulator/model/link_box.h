// Where a link's material can be.
#pragma once

#include <Eigen/Geometry>

#include "simulator/model/model.h"

namespace plumbline::model {

/// Where the material of a link lies, in the link's frame, m: the box around its own joint, the joints that
/// it carries, and the homogeneous cuboid with the link's mass and inertia, whose half lengths are
///   a_i^2 = 3/2 (I_j + I_k - I_i) / m,  I the moments about the frame's axes at the centre of mass.
/// Source of the last: the moments m (b^2 + c^2) / 3 of a cuboid, solved for its half lengths.
Eigen::AlignedBox3d link_box(const model::Skeleton& skeleton, int body);

}  // namespace plumbline::model
