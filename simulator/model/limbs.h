// The limbs of a robot: what a fork of its tree of links carries, with all the motors on it.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::model {

/// Places for laws that act on several motors alike. "world": all motors of the robot. A link: the motors
/// that move nothing but this link and those behind it, where its parent has a further child with motors (a
/// leg's first link, an arm's). Only with two motors or more, in the order of the links.
std::vector<std::string> limbs(const Model& model);

/// Is the motor one of that limb's? `limb` is one of limbs().
bool is_on_limb(const Model& model, const std::string& limb, const Motor& motor);

}  // namespace plumbline::model
