// Laws that are members of one family: which of them it is may stay open where the family is sure.
#pragma once

#include "simulator/model/model.h"

namespace plumbline::validation {

/// Are both at one place, and of one family: friction, springs and stops, what a command becomes on its way
/// to the torque, what a sensor adds, or what the ground is like?
bool are_of_one_family(const model::EffectUse& one, const model::EffectUse& other);

bool is_friction(const effects::Law& law);

}  // namespace plumbline::validation
