// Joints whose position another joint's gives: URDF's <mimic>, MJCF's <equality> with <joint>.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/trace/error.h"

namespace plumbline::model {

/// position(joint) = multiplier * position(to) + offset, rad or m; `to` empty: it is held at the offset.
struct JointTie {
  std::string joint, to;
  double multiplier = 1.0, offset = 0.0;
  Place_in_file place;  ///< of the statement, for messages
};

/// Ties the skeleton's joints: each gets its zero where the offset puts it, so that Joint::follows, a factor,
/// is left; one that is held becomes a fixed joint. Ties of fixed joints are passed over. Throws InputError
/// where a joint is unknown, or `to` is no moving joint that is tied to none.
void tie_joints(const std::vector<JointTie>& ties, Skeleton& skeleton);

}  // namespace plumbline::model
