// SDFormat and URDF to a Skeleton, through libsdformat.
#include <algorithm>

#include "simulator/model/joint_chain.h"
#include "simulator/model/joint_ties.h"
#include "simulator/model/mjcf_file.h"
#include "simulator/model/moving_masses.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/sdformat_access.h"

namespace plumbline::model {
namespace {

/// A link or joint before the tree is put in order; poses in the model's frame.
struct LooseLink {
  Body body;
  Eigen::Isometry3d X_ML = Eigen::Isometry3d::Identity();
};
struct LooseJoint {
  Joint joint;
  std::string parent, child;  ///< parent "world": the world
  enum class Kind { single, free, ball, universal, planar } kind = Kind::single;
  Eigen::Vector3d first = Eigen::Vector3d::UnitZ();   ///< axis of a universal joint, normal of a planar one
  Eigen::Vector3d second = Eigen::Vector3d::UnitZ();  ///< the other axis of a universal joint
  Eigen::Isometry3d X_MJ = Eigen::Isometry3d::Identity();
};

/// Puts links and joints into tree order and hangs the tree on the world.
class TreeBuilder {
 public:
  TreeBuilder(const SkeletonXml& xml, std::vector<LooseLink> links, std::vector<LooseJoint> joints,
              const Eigen::Isometry3d& X_WM)
      : xml_(xml), links_(std::move(links)), joints_(std::move(joints)), X_WM_(X_WM) {
    inboard_.assign(links_.size(), -1);
    index_.assign(links_.size(), -1);
  }

  void build(Skeleton& skeleton) {
    find_inboard_joints();
    hang_on_world(skeleton);
    while (add_children(skeleton)) {
    }
    refuse_loose_links();
    close_loops(skeleton);
    hold_moving_massless(xml_, skeleton);
    judge_unusual(xml_, skeleton);
  }

 private:
  int link_index(const std::string& name) const {
    const auto found = std::find_if(links_.begin(), links_.end(),
                                    [&](const LooseLink& link) { return link.body.name == name; });
    return found == links_.end() ? -1 : static_cast<int>(found - links_.begin());
  }

  void find_inboard_joints() {
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const int child = link_index(joints_[j].child);
      const std::string& name = joints_[j].joint.name;
      if (child < 0 || (joints_[j].parent != "world" && link_index(joints_[j].parent) < 0)) {
        xml_.refuse({name, xml_.line_of_joint(name)},
                    "a joint between " + joints_[j].parent + " and " + joints_[j].child,
                    "a joint between two links of the model, or the world and a link");
      }
      int& inboard = inboard_[static_cast<std::size_t>(child)];
      if (inboard >= 0) {
        refuse_unless_it_closes(joints_[j]);
        closing_.push_back(j);
        continue;
      }
      inboard = static_cast<int>(j);
    }
  }

  /// A second joint to a link closes a loop.
  void refuse_unless_it_closes(const LooseJoint& loose) const {
    const bool slides = loose.joint.type == JointType::prismatic;
    if ((loose.kind != LooseJoint::Kind::single && loose.kind != LooseJoint::Kind::ball) || slides) {
      const std::string& name = loose.joint.name;
      xml_.refuse({name, xml_.line_of_joint(name)},
                  "link " + loose.child + " as the child of a second joint (a closed loop) that is " +
                      (slides ? "prismatic" : "of several degrees of freedom"),
                  "a second joint that is revolute, ball or fixed; or exchange it with the first");
    }
  }

  void close_loops(Skeleton& skeleton) const {
    for (const std::size_t j : closing_) {
      const LooseJoint& loose = joints_[j];
      const bool ball = loose.kind == LooseJoint::Kind::ball;
      const bool fixed = !ball && loose.joint.type == JointType::fixed;
      Loop loop;
      loop.name = loose.joint.name;
      loop.file = xml_.file();
      loop.line = xml_.line_of_joint(loop.name);
      loop.type = ball ? Loop::Type::connect : fixed ? Loop::Type::weld : Loop::Type::hinge;
      const Eigen::Quaterniond about = Eigen::Quaterniond::FromTwoVectors(
          Eigen::Vector3d::UnitZ(), ball || fixed ? Eigen::Vector3d::UnitZ() : loose.joint.axis);
      const auto child = static_cast<std::size_t>(link_index(loose.child));
      const int parent = loose.parent == "world" ? -1 : link_index(loose.parent);
      const auto end = [&](int body, const Eigen::Isometry3d& X) {
        return LoopEnd{body, X.translation(), X.linear() * about.toRotationMatrix()};
      };
      loop.ends = {parent < 0 ? end(-1, X_WM_ * loose.X_MJ)
                              : end(index_[static_cast<std::size_t>(parent)],
                                    links_[static_cast<std::size_t>(parent)].X_ML.inverse() * loose.X_MJ),
                   end(index_[child], links_[child].X_ML.inverse() * loose.X_MJ)};
      if (loose.joint.damping > 0.0 || loose.joint.friction > 0.0) {
        skeleton.left_out.push_back("The damping and friction of joint " + loop.name +
                                    ", which closes a loop.");
      }
      skeleton.loops.push_back(std::move(loop));
    }
  }

  /// Without any joint to the world, a single root link is fixed to it.
  void hang_on_world(Skeleton& skeleton) {
    const auto to_world = [](const LooseJoint& joint) { return joint.parent == "world"; };
    if (std::any_of(joints_.begin(), joints_.end(), to_world)) {
      return;
    }
    const auto roots = std::count(inboard_.begin(), inboard_.end(), -1);
    if (roots != 1) {
      xml_.refuse({"", 0}, std::to_string(roots) + " links that are the child of no joint",
                  "one root link, or joints to the world");
    }
    const auto root =
        static_cast<std::size_t>(std::find(inboard_.begin(), inboard_.end(), -1) - inboard_.begin());
    Joint joint;
    joint.name = "world_to_" + links_[root].body.name;
    while (xml_.line_of_joint(joint.name) != 0) {
      joint.name += "_";
    }
    joint.X_PJ = X_WM_ * links_[root].X_ML;
    append(skeleton, root, joint);
  }

  void append(Skeleton& skeleton, std::size_t link, Joint joint) {
    index_[link] = static_cast<int>(skeleton.bodies.size());
    joint.child = index_[link];
    skeleton.bodies.push_back(links_[link].body);
    skeleton.joints.push_back(std::move(joint));
  }

  static bool is_on_world(const Skeleton& skeleton, int body) {
    while (body >= 0 && skeleton.joints[static_cast<std::size_t>(body)].type == JointType::fixed) {
      body = skeleton.joints[static_cast<std::size_t>(body)].parent;
    }
    return body < 0;
  }

  /// A free joint on the world has no frame of its own: its coordinates are the link's place in the world.
  void append_many(Skeleton& skeleton, std::size_t link, const LooseJoint& loose, Joint ends) {
    using Kind = LooseJoint::Kind;
    std::vector<ChainAxis> axes;
    if (loose.kind == Kind::free) {
      const bool on_world = is_on_world(skeleton, ends.parent);
      if (on_world) {
        ends.parent = -1;
        ends.X_PJ = ends.X_CJ = Eigen::Isometry3d::Identity();
      }
      axes = free_chain(free_prefix(skeleton, on_world, ends.name));
    } else if (loose.kind == Kind::ball) {
      axes = ball_chain(ends.name);
    } else if (loose.kind == Kind::universal) {
      axes = universal_chain(ends.name, loose.first, loose.second);
    } else {
      axes = planar_chain(ends.name, loose.first);
    }
    append_chain(skeleton, links_[link].body, ends, axes);
    index_[link] = static_cast<int>(skeleton.bodies.size()) - 1;
  }

  /// Appends the links whose parents are in; true when there was one.
  bool add_children(Skeleton& skeleton) {
    bool added = false;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (index_[i] >= 0 || inboard_[i] < 0) {
        continue;
      }
      const LooseJoint& loose = joints_[static_cast<std::size_t>(inboard_[i])];
      const bool on_world = loose.parent == "world";
      const auto parent = static_cast<std::size_t>(on_world ? 0 : link_index(loose.parent));
      if (!on_world && index_[parent] < 0) {
        continue;
      }
      Joint joint = loose.joint;
      joint.parent = on_world ? -1 : index_[parent];
      joint.X_PJ = on_world ? X_WM_ * loose.X_MJ : links_[parent].X_ML.inverse() * loose.X_MJ;
      joint.X_CJ = links_[i].X_ML.inverse() * loose.X_MJ;
      if (loose.kind == LooseJoint::Kind::single) {
        append(skeleton, i, std::move(joint));
      } else {
        append_many(skeleton, i, loose, std::move(joint));
      }
      added = true;
    }
    return added;
  }

  void refuse_loose_links() const {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (index_[i] < 0) {
        const std::string& name = links_[i].body.name;
        xml_.refuse(
            {name, xml_.line_of_link(name)}, "a link that no chain of joints connects to the world",
            "a joint that does: a base that floats has a URDF joint of type floating, or the model says "
            "`floating_base: true`");
      }
    }
  }

  const SkeletonXml& xml_;
  std::vector<LooseLink> links_;
  std::vector<LooseJoint> joints_;
  Eigen::Isometry3d X_WM_;
  std::vector<int> inboard_;          // joint of each link, -1: none
  std::vector<std::size_t> closing_;  // joints to links that have one already
  std::vector<int> index_;            // body of each link, -1: not yet placed
};

LooseLink read_link(const sdf::Link& link, const SkeletonXml& xml) {
  LooseLink loose;
  loose.body.name = link.Name();
  ignition::math::Pose3d pose;
  refuse_errors(link.SemanticPose().Resolve(pose, "__model__"), xml);
  loose.X_ML = to_eigen(pose);
  if (const RigidPart* stated = xml.unusual(link.Name())) {
    loose.body.mass = stated->mass;
    loose.body.com = stated->com;
    loose.body.inertia = stated->inertia;
  } else if (xml.has_inertial(link.Name())) {
    const ignition::math::Inertiald& inertial = link.Inertial();
    loose.body.mass = inertial.MassMatrix().Mass();
    loose.body.com = to_eigen(inertial.Pose().Pos());
    loose.body.inertia = to_eigen(inertial.Moi());  // turned into the link's axes
  }
  return loose;
}

JointType joint_type(sdf::JointType type) {
  switch (type) {
    case sdf::JointType::PRISMATIC:
      return JointType::prismatic;
    case sdf::JointType::FIXED:
      return JointType::fixed;
    default:
      return JointType::revolute;  // SkeletonXml lets only these through
  }
}

/// Direction of an axis in the joint's frame.
Eigen::Vector3d axis_of(const sdf::Joint& joint, unsigned int which, const SkeletonXml& xml) {
  const sdf::JointAxis* axis = joint.Axis(which);
  ignition::math::Vector3d direction;
  if (axis != nullptr) {
    refuse_errors(axis->ResolveXyz(direction), xml);
  }
  if (!(direction.Length() > 0.0)) {
    const std::string name = xml.joint_name(joint.Name());
    xml.refuse({name, xml.line_of_joint(name)}, which == 0 ? "no axis" : "no second axis",
               "an axis of a joint that moves");
  }
  return to_eigen(direction).normalized();
}

/// What kind of several degrees of freedom it has, if it has.
void read_kind(const sdf::Joint& joint, const SkeletonXml& xml, LooseJoint& loose) {
  using Kind = LooseJoint::Kind;
  const std::string name = xml.joint_name(joint.Name());
  if (xml.urdf_joint(name) == UrdfJoint::floating) {
    loose.kind = Kind::free;
  } else if (xml.urdf_joint(name) == UrdfJoint::planar) {
    loose.kind = Kind::planar;
    loose.first = xml.planar_normal(name);
  } else if (joint.Type() == sdf::JointType::BALL) {
    loose.kind = Kind::ball;
  } else if (joint.Type() == sdf::JointType::UNIVERSAL) {
    loose.kind = Kind::universal;
    loose.first = axis_of(joint, 0, xml);
    loose.second = axis_of(joint, 1, xml);
  }
}

LooseJoint read_joint(const sdf::Joint& joint, const SkeletonXml& xml) {
  LooseJoint loose;
  loose.joint.name = xml.joint_name(joint.Name());
  loose.joint.type = joint_type(joint.Type());
  refuse_errors(joint.ResolveParentLink(loose.parent), xml);
  refuse_errors(joint.ResolveChildLink(loose.child), xml);
  ignition::math::Pose3d pose;
  refuse_errors(joint.SemanticPose().Resolve(pose, "__model__"), xml);
  loose.X_MJ = to_eigen(pose);
  read_kind(joint, xml, loose);
  if (loose.joint.type == JointType::fixed || loose.kind != LooseJoint::Kind::single) {
    return loose;
  }
  loose.joint.axis = axis_of(joint, 0, xml);
  const sdf::JointAxis* axis = joint.Axis(0);
  loose.joint.damping = std::max(0.0, axis->Damping());
  loose.joint.friction = std::max(0.0, axis->Friction());
  return loose;
}

/// What a URDF's joints mimic.
std::vector<JointTie> mimics_of(const SkeletonXml& xml, const Skeleton& skeleton) {
  std::vector<JointTie> ties;
  for (const Joint& joint : skeleton.joints) {
    if (const SkeletonXml::Mimic* mimic = xml.mimic(joint.name)) {
      ties.push_back({joint.name,
                      mimic->joint,
                      mimic->multiplier,
                      mimic->offset,
                      {xml.file(), xml.line_of_joint(joint.name), joint.name + " mimic"}});
    }
  }
  return ties;
}

Skeleton read_loaded(const LoadedSdf& loaded, const SkeletonXml& xml) {
  ignition::math::Pose3d pose = loaded.model.RawPose();
  if (loaded.world != nullptr) {
    refuse_errors(loaded.model.SemanticPose().Resolve(pose), xml);
  }
  std::vector<LooseLink> links;
  for (std::size_t i = 0; i < loaded.model.LinkCount(); ++i) {
    links.push_back(read_link(*loaded.model.LinkByIndex(i), xml));
  }
  std::vector<LooseJoint> joints;
  for (std::size_t i = 0; i < loaded.model.JointCount(); ++i) {
    joints.push_back(read_joint(*loaded.model.JointByIndex(i), xml));
  }
  Skeleton skeleton;
  skeleton.file = xml.file();
  if (loaded.world != nullptr && xml.states_gravity()) {
    skeleton.gravity = to_eigen(loaded.world->Gravity());
  }
  TreeBuilder(xml, std::move(links), std::move(joints), to_eigen(pose)).build(skeleton);
  tie_joints(mimics_of(xml, skeleton), skeleton);
  check_joint_names(skeleton);
  return skeleton;
}

}  // namespace

Skeleton read_skeleton(const std::string& path) {
  if (is_mjcf(path)) {
    return read_mjcf(path);
  }
  SkeletonXml xml(path);
  Skeleton skeleton;
  with_sdformat(xml, UrdfShapes::left_out,
                [&](const LoadedSdf& loaded) { skeleton = read_loaded(loaded, xml); });
  return skeleton;
}

}  // namespace plumbline::model
