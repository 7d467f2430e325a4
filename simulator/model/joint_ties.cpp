#include "simulator/model/joint_ties.h"

#include <algorithm>

namespace plumbline::model {
namespace {

bool is_tied(const std::vector<JointTie>& ties, const std::string& joint) {
  return std::any_of(ties.begin(), ties.end(), [&](const JointTie& tie) { return tie.joint == joint; });
}

Joint* find_joint(Skeleton& skeleton, const std::string& name) {
  const auto found = std::find_if(skeleton.joints.begin(), skeleton.joints.end(),
                                  [&](const Joint& joint) { return joint.name == name; });
  return found == skeleton.joints.end() ? nullptr : &*found;
}

/// Moves the joint's zero to where its position is `offset` now.
void shift_zero(Joint& joint, double offset) {
  const Eigen::Vector3d axis = joint.axis.normalized();
  if (joint.type == JointType::revolute) {
    joint.X_PJ.rotate(Eigen::AngleAxisd(offset, axis));
  } else {
    joint.X_PJ.translate(offset * axis);
  }
  joint.reference = 0.0;
}

}  // namespace

void tie_joints(const std::vector<JointTie>& ties, Skeleton& skeleton) {
  for (const JointTie& tie : ties) {
    Joint* joint = find_joint(skeleton, tie.joint);
    if (joint == nullptr) {
      throw InputError(tie.place, "\"" + tie.joint + "\"", "the name of a joint of one degree of freedom");
    }
    if (joint->type == JointType::fixed) {
      continue;
    }
    if (!tie.to.empty()) {
      const Joint* master = find_joint(skeleton, tie.to);
      if (master == nullptr || master->type == JointType::fixed || is_tied(ties, tie.to)) {
        throw InputError(tie.place, "\"" + tie.to + "\"", "the name of a moving joint that mimics none");
      }
    }
    shift_zero(*joint, tie.offset);
    if (tie.to.empty()) {
      joint->type = JointType::fixed;
    } else {
      joint->mimics = tie.to;
      joint->follows = tie.multiplier;
    }
  }
}

}  // namespace plumbline::model
