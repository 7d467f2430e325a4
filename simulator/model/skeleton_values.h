// What a model says of its skeleton's bodies and joints, its effects taken in: what a simulator of rigid
// bodies can be told.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::model {

/// What damps and loads a joint: N m s/rad, N m and kg m^2 (N s/m, N and kg of a slide).
struct JointValues {
  double damping = 0.0, friction = 0.0, armature = 0.0;
};

struct SkeletonValues {
  std::vector<Body> bodies;         ///< with added_mass, com_shift, link_inertia and payload in them
  std::vector<JointValues> joints;  ///< one for each of the skeleton
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<std::string> left_out;  ///< what has no place here, a sentence each
};

/// A place (coordinate, motor, pulley) that turns by factor f for each turn of one joint alone, through rigid
/// ratios, gives that joint f^2 d of its viscous damping d, |f| L of its Coulomb level L, and f^2 J of its
/// inertia J; places that several joints move together are left out and said. Effects at their null values
/// say nothing. A ratio that an effect releases counts as rigid. Throws InputError when a body has no mass
/// left.
/// Source: the power of a force and the kinetic energy are the same in either coordinate; Featherstone, Rigid
/// Body Dynamics Algorithms (2008), section 9.6 for rotors.
SkeletonValues skeleton_values(const Model& model);

}  // namespace plumbline::model
