// A planar chain of links with one foot, in MuJoCo's XML.
#pragma once

#include <string>

#include "simulator/model/model.h"

namespace plumbline::benchmarks {

/// Links, joints, and the springs and dampers at them; a site "foot"; an actuator without force whose
/// activation is the caller's (dyntype user). No contacts, constraints or sensors. Throws std::runtime_error
/// for a model that this cannot hold: a branch, a turned joint frame, motors, other effects at joints.
std::string chain_xml(const model::Model& model);

}  // namespace plumbline::benchmarks
