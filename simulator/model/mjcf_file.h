// Skeletons from MJCF, the models of MuJoCo, by tinyxml2 alone: no MuJoCo is needed.
#pragma once

#include <string>

#include "simulator/model/model.h"

namespace plumbline::model {

/// Bodies, joints and inertias of an MJCF file: `compiler` (angle, eulerseq, inertiafromgeom), `option
/// gravity`, default classes, poses by pos with quat, euler, axisangle, xyaxes or zaxis; `inertial`, or
/// inertias from the geoms (sphere, capsule, cylinder, box, ellipsoid, closed mesh; mass or density); joints
/// of type hinge and slide with axis, pos, damping, frictionloss and armature; ball and free ones as chains
/// (joint_chain.h); spheres that may touch the ground. A body with several joints becomes as many
/// bodies, those before the last without mass, named BODY_of_JOINT. Everything else (actuators, tendons,
/// equalities, contacts, sensors, joint springs and limits) is named in Skeleton::left_out. Throws InputError
/// (file, line, element) for a free joint inside another body, elements that make bodies (frame, replicate,
/// ...), inertias that an open mesh would have to give, and numbers that no rigid body has. Included files
/// are read (mjcf_document.h). Source: MuJoCo documentation, "XML Reference", version 2.2.
Skeleton read_mjcf(const std::string& path);

/// Is this an MJCF file (root element <mujoco>)?
bool is_mjcf(const std::string& path);

}  // namespace plumbline::model
