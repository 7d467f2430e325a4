#include "simulator/model/moving_masses.h"

#include <algorithm>

#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

/// A principal moment below zero by more than rounding, in words; else empty.
std::string no_body(const Eigen::Matrix3d& inertia) {
  constexpr double kFileRounding = 1e-6;  // of the largest: files round their numbers
  constexpr double kNothing = 1e-12;      // kg m^2
  const Eigen::Vector3d principal = principal_moments(inertia);
  return principal[0] < -kFileRounding * principal[2] - kNothing
             ? "a principal moment of " + number_text(principal[0], 6) + " kg m^2"
             : "";
}

/// Bodies that move as one.
struct Rigid {
  std::vector<std::size_t> of;                ///< by body: the one that carries it
  std::vector<bool> moves;                    ///< by body: is there a joint between it and the world?
  std::vector<std::vector<RigidPart>> parts;  ///< by the body that carries them, in its axes
};

Rigid joined(const Skeleton& skeleton) {
  const std::size_t n = skeleton.bodies.size();
  Rigid rigid{std::vector<std::size_t>(n), std::vector<bool>(n, true),
              std::vector<std::vector<RigidPart>>(n)};
  std::vector<Eigen::Isometry3d> pose(n, Eigen::Isometry3d::Identity());  // on the body that carries it
  for (std::size_t i = 0; i < n; ++i) {
    const Joint& joint = skeleton.joints[i];
    const Body& body = skeleton.bodies[i];
    const auto parent = static_cast<std::size_t>(std::max(joint.parent, 0));
    rigid.of[i] = i;
    rigid.moves[i] = joint.type != JointType::fixed || (joint.parent >= 0 && rigid.moves[parent]);
    if (rigid.moves[i] && joint.type == JointType::fixed) {
      rigid.of[i] = rigid.of[parent];
      pose[i] = pose[parent] * joint.X_PJ * joint.X_CJ.inverse();
    }
    if (body.mass > 0.0) {
      rigid.parts[rigid.of[i]].push_back(placed({body.mass, body.com, body.inertia}, body.mass, pose[i]));
    }
  }
  return rigid;
}

}  // namespace

std::vector<double> carried_masses(const Skeleton& skeleton) {
  std::vector<double> carried(skeleton.bodies.size());
  for (std::size_t i = skeleton.bodies.size(); i-- > 0;) {
    carried[i] += skeleton.bodies[i].mass;
    const int parent = skeleton.joints[i].parent;
    if (parent >= 0) {
      carried[static_cast<std::size_t>(parent)] += carried[i];
    }
  }
  return carried;
}

void hold_moving_massless(const SkeletonXml& xml, Skeleton& skeleton) {
  const std::vector<double> carried = carried_masses(skeleton);
  for (std::size_t i = skeleton.bodies.size(); i-- > 0;) {
    Joint& joint = skeleton.joints[i];
    if (joint.type == JointType::fixed || carried[i] > 0.0) {
      continue;
    }
    const std::string& name = skeleton.bodies[i].name;
    if (!xml.is_urdf() || joint.floats) {
      xml.refuse({name, xml.line_of_link(name)}, "no <inertial> of a link that moves",
                 "its mass, centre of mass and inertia");
    }
    joint.type = JointType::fixed;
    skeleton.left_out.push_back("Joint " + joint.name + " of link " + name +
                                ", which carries nothing that has mass: it is held at zero.");
  }
}

void judge_unusual(const SkeletonXml& xml, Skeleton& skeleton) {
  const Rigid rigid = joined(skeleton);
  for (std::size_t i = 0; i < skeleton.bodies.size(); ++i) {
    const std::string& name = skeleton.bodies[i].name;
    if (xml.unusual(name) == nullptr || !rigid.moves[i]) {
      continue;
    }
    const std::string reason = no_body(together(rigid.parts[rigid.of[i]]).inertia);
    if (!reason.empty()) {
      xml.refuse({name + " inertia", xml.line_of_link(name)}, reason + " of it and what is fixed to it",
                 "moments that are not below zero");
    }
    skeleton.left_out.push_back("The inertia of link " + name +
                                ", which no body has, is taken as the file states it.");
  }
}

}  // namespace plumbline::model
