#include "simulator/model/mjcf_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "simulator/model/joint_chain.h"
#include "simulator/model/mjcf_equality.h"
#include "simulator/model/mjcf_inertia.h"
#include "simulator/model/mjcf_values.h"
#include "simulator/model/moving_masses.h"
#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

class MjcfReader : private MjcfValues {
 public:
  explicit MjcfReader(const MjcfDocument& document)
      : MjcfValues(document), root_(&document.root()), inertia_(document) {}

  Skeleton read() {
    skeleton_.file = source_.file();
    skeleton_.gravity = Vector3d(0.0, 0.0, -9.81);
    for (const XMLElement* option : source_.sections("option")) {
      if (option->Attribute("gravity") != nullptr) {
        skeleton_.gravity = vector(*option, option->Attribute("gravity"), "gravity");
      }
    }
    const std::vector<const XMLElement*> worlds = source_.sections("worldbody");
    if (worlds.empty()) {
      refuse(*root_, "no <worldbody>", "one that holds the bodies");
    }
    for (const XMLElement* world : worlds) {
      read_children(*world, -1, "");
    }
    if (skeleton_.bodies.empty()) {
      refuse(*worlds.front(), "no <body>", "at least one");
    }
    refuse_massless();
    check_joint_names(skeleton_);
    read_mjcf_equalities(source_, skeleton_);
    name_what_is_left_out();
    return std::move(skeleton_);
  }

 private:
  std::string fresh_name(const XMLElement& element, const std::string& fallback) {
    const char* given = element.Attribute("name");
    std::set<std::string>& taken = names_[element.Name()];  // a joint may be called as its body is
    std::string name = given != nullptr ? given : fallback;
    if (given != nullptr && taken.count(name) != 0) {
      refuse(element, "this name twice", "each name once");
    }
    for (int i = 2; !taken.insert(name).second; ++i) {
      name = fallback + "_" + std::to_string(i);
    }
    return name;
  }

  void read_body(const XMLElement& element, int parent, std::string childclass) {
    if (const char* own = element.Attribute("childclass")) {
      childclass = own;
      if (!defaults_.has_class(childclass)) {
        refuse(element, "childclass \"" + childclass + "\"", "the name of a default class");
      }
    }
    Body body;
    body.name = fresh_name(element, "body_" + std::to_string(skeleton_.bodies.size() + 1));
    inertia_.read(element, childclass, body);
    const Eigen::Isometry3d X_PB = pose(element, childclass);
    append_joints(element, childclass, body, X_PB, parent);
    note_spheres(element, childclass, body.name);
    read_children(element, static_cast<int>(skeleton_.bodies.size()) - 1, childclass);
  }

  void read_children(const XMLElement& element, int parent, const std::string& childclass) {
    for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string kind = child->Name();
      if (kind == "body") {
        read_body(*child, parent, childclass);
      } else if (kind == "frame" || kind == "replicate" || kind == "attach" || kind == "composite" ||
                 kind == "flexcomp") {
        refuse(*child, "<" + kind + ">, which makes bodies", "bodies alone (MuJoCo's compile writes them)");
      }
    }
  }

  std::vector<const XMLElement*> joints_of(const XMLElement& element) const {
    std::vector<const XMLElement*> joints;
    for (const XMLElement* one = element.FirstChildElement(); one != nullptr;
         one = one->NextSiblingElement()) {
      const std::string name = one->Name();
      if (name == "joint" || name == "freejoint") {
        joints.push_back(one);
      }
    }
    return joints;
  }

  std::string kind_of(const XMLElement& joint, const std::string& childclass) const {
    if (std::string(joint.Name()) == "freejoint") {
      return "free";
    }
    const char* type = defaults_.attribute(joint, "type", childclass);
    return type == nullptr ? "hinge" : type;
  }

  /// The body behind its joints; between them bodies without mass.
  void append_joints(const XMLElement& element, const std::string& childclass, const Body& body,
                     const Eigen::Isometry3d& X_PB, int parent) {
    const std::vector<const XMLElement*> joints = joints_of(element);
    if (joints.empty()) {
      Joint joint;
      joint.name = "fix_" + body.name;
      joint.parent = parent;
      joint.X_PJ = X_PB;
      append(body, std::move(joint));
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const std::string kind = kind_of(*joints[j], childclass);
      if (kind == "free") {
        append_free(*joints[j], childclass, body, X_PB, {parent, joints.size()});
        return;
      }
      Joint joint = read_joint(*joints[j], kind, childclass, body.name);
      const Vector3d at = position_of(*joints[j], childclass);
      const Eigen::Isometry3d X_BJ(Eigen::Translation3d(at.x(), at.y(), at.z()));
      joint.parent = j == 0 ? parent : static_cast<int>(skeleton_.bodies.size()) - 1;
      joint.X_PJ = (j == 0 ? X_PB : Eigen::Isometry3d::Identity()) * X_BJ * back_from_reference(joint);
      joint.X_CJ = X_BJ;
      Body here = body;
      if (j + 1 < joints.size()) {
        here = Body{};
        here.name = body.name + "_of_" + joint.name;
      }
      if (kind == "ball") {
        append_chain(skeleton_, here, joint, ball_chain(joint.name));
      } else {
        append(here, std::move(joint));
      }
    }
  }

  struct Place {
    int parent;
    std::size_t joints;  // of the body
  };
  /// Its coordinates are the body's place in the world, as MuJoCo's are.
  void append_free(const XMLElement& element, const std::string& childclass, const Body& body,
                   const Eigen::Isometry3d& X_PB, const Place& place) {
    if (place.parent >= 0 || place.joints != 1) {
      refuse(element,
             place.parent >= 0 ? "a free joint of a body inside another" : "a free joint beside others",
             "a free joint alone, in a body of <worldbody>");
    }
    Joint ends;
    ends.name = fresh_name(element, body.name);
    ends.parent = -1;
    const std::string prefix = free_prefix(skeleton_, true, ends.name);
    append_chain(skeleton_, body, ends, free_chain(prefix));
    name_passive(element, "free joint " + prefix, childclass);
    if (!X_PB.isApprox(Eigen::Isometry3d::Identity())) {
      skeleton_.left_out.push_back("The pose of the free body " + body.name + ": " + prefix + "_x to " +
                                   prefix + "_roll are its place in the world.");
    }
  }

  /// What a joint of several degrees of freedom says of friction and inertia.
  void name_passive(const XMLElement& element, const std::string& what, const std::string& childclass) {
    for (const char* name : {"damping", "frictionloss", "armature", "stiffness"}) {
      if (std::string(element.Name()) == "joint" && number(element, name, childclass, 0.0) != 0.0) {
        skeleton_.left_out.push_back("The " + std::string(name) + " of the " + what + ".");
      }
    }
  }

  void append(const Body& body, Joint joint) {
    joint.child = static_cast<int>(skeleton_.bodies.size());
    skeleton_.bodies.push_back(body);
    skeleton_.joints.push_back(std::move(joint));
  }

  /// The file's pose is that at the joint's reference; X_PJ is that at zero.
  static Eigen::Isometry3d back_from_reference(const Joint& joint) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    if (joint.type == JointType::revolute) {
      X.linear() = Eigen::AngleAxisd(-joint.reference, joint.axis).toRotationMatrix();
    } else if (joint.type == JointType::prismatic) {
      X.translation() = -joint.reference * joint.axis;
    }
    return X;
  }

  Vector3d position_of(const XMLElement& joint, const std::string& childclass) const {
    const char* at = defaults_.attribute(joint, "pos", childclass);
    return at == nullptr ? Vector3d::Zero() : vector(joint, at, "pos");
  }

  Joint read_joint(const XMLElement& element, const std::string& kind, const std::string& childclass,
                   const std::string& body) {
    if (kind != "hinge" && kind != "slide" && kind != "ball") {
      refuse(element, "a joint of type " + kind, "hinge, slide, ball or free");
    }
    Joint joint;
    joint.name = fresh_name(element, body + "_joint");
    limits_ += defaults_.attribute(element, "range", childclass) != nullptr ? 1 : 0;
    if (kind == "ball") {
      name_passive(element, "ball joint " + joint.name, childclass);
      return joint;
    }
    joint.type = kind == "hinge" ? JointType::revolute : JointType::prismatic;
    const char* axis = defaults_.attribute(element, "axis", childclass);
    joint.axis = axis == nullptr ? Vector3d::UnitZ() : vector(element, axis, "axis");
    if (!(joint.axis.norm() > 0.0)) {
      refuse(element, "an axis of zeros", "the direction of the joint");
    }
    joint.axis.normalize();
    joint.damping = not_negative(element, "damping", childclass);
    joint.friction = not_negative(element, "frictionloss", childclass);
    joint.armature = not_negative(element, "armature", childclass);
    const double unit = kind == "hinge" ? angle_ : 1.0;
    joint.stiffness = not_negative(element, "stiffness", childclass);
    joint.rest = unit * number(element, "springref", childclass, 0.0);
    joint.reference = unit * number(element, "ref", childclass, 0.0);
    return joint;
  }

  /// Spheres that may touch the ground (contype and conaffinity are not both 0).
  void note_spheres(const XMLElement& element, const std::string& childclass, const std::string& body) {
    for (const XMLElement* geom = element.FirstChildElement("geom"); geom != nullptr;
         geom = geom->NextSiblingElement("geom")) {
      const char* type = defaults_.attribute(*geom, "type", childclass);
      const bool touches = number(*geom, "contype", childclass, 1.0) != 0.0 ||
                           number(*geom, "conaffinity", childclass, 1.0) != 0.0;
      if (!touches) {
        continue;
      }
      const std::string kind = type == nullptr ? "sphere" : type;
      if (kind == "capsule") {
        note_capsule(*geom, childclass, body);
        continue;
      }
      if (kind != "sphere" || defaults_.attribute(*geom, "mesh", childclass) != nullptr) {
        ++shapes_;
        continue;
      }
      ContactSphere sphere;
      sphere.name = fresh_name(*geom, body + "_sphere");
      sphere.body = static_cast<int>(skeleton_.bodies.size()) - 1;
      sphere.centre = pose(*geom, childclass).translation();
      sphere.radius = number(*geom, "size", childclass, 0.0);
      if (!(sphere.radius > 0.0)) {
        refuse(*geom, "a sphere of radius " + number_text(sphere.radius) + " m", "a radius above zero");
      }
      skeleton_.spheres.push_back(std::move(sphere));
    }
  }

  /// On a plane a capsule touches with one of its ends, which are spheres, or with both.
  void note_capsule(const XMLElement& geom, const std::string& childclass, const std::string& body) {
    const Shape rod = shape_of(geom, childclass);
    ContactSphere end;
    end.shape = fresh_name(geom, body + "_capsule");
    end.body = static_cast<int>(skeleton_.bodies.size()) - 1;
    end.radius = rod.size.empty() ? 0.0 : rod.size[0];
    if (!(end.radius > 0.0) || rod.size.size() < 2 || rod.size[1] < 0.0) {
      refuse(geom, "a capsule without radius or length",
             "size=\"radius half_length\", or fromto and a radius");
    }
    for (const double side : {1.0, -1.0}) {
      end.name = end.shape + (side > 0.0 ? "_1" : "_2");
      end.centre = rod.X * Vector3d(0.0, 0.0, side * rod.size[1]);
      skeleton_.spheres.push_back(end);
    }
  }

  /// A joint that moves must move mass.
  void refuse_massless() const {
    const std::vector<double> carried = carried_masses(skeleton_);
    for (std::size_t i = skeleton_.bodies.size(); i-- > 0;) {
      const Joint& joint = skeleton_.joints[i];
      if (joint.type != JointType::fixed && !(carried[i] > 0.0)) {
        throw InputError({source_.file(), 0, skeleton_.bodies[i].name}, "no mass of a body that moves",
                         "<inertial>, or geoms with a density");
      }
    }
  }

  void name_what_is_left_out() {
    struct Part {
      const char *name, *advice;
    };
    const std::array<Part, 6> parts{{{"actuator", "state them as `motors` of the model file"},
                                     {"tendon", ""},
                                     {"equality", ""},
                                     {"contact", "state its pairs as `contacts` of the model file"},
                                     {"sensor", "state them as `sensors` of the model file"},
                                     {"keyframe", ""}}};
    for (const Part& part : parts) {
      int count = 0;
      for (const XMLElement* section : source_.sections(part.name)) {
        for (const XMLElement* one = section->FirstChildElement(); one != nullptr;
             one = one->NextSiblingElement()) {
          count += is_mjcf_equality(*one) ? 0 : 1;
        }
      }
      if (count > 0) {
        skeleton_.left_out.push_back("<" + std::string(part.name) + "> with " + std::to_string(count) +
                                     (count == 1 ? " element" : " elements") +
                                     (*part.advice != '\0' ? std::string(": ") + part.advice : "") + ".");
      }
    }
    if (shapes_ > 0) {
      skeleton_.left_out.push_back(
          "The contact of " + std::to_string(shapes_) +
          " geoms that are neither spheres nor capsules: state points of them as `feet`.");
    }
    if (limits_ > 0) {
      skeleton_.left_out.push_back("The ranges of " + std::to_string(limits_) +
                                   " joints: state a stop as the effect `hard_stop`.");
    }
  }

  const XMLElement* root_;
  MjcfInertia inertia_;
  std::map<std::string, std::set<std::string>> names_;  // by kind of element
  int limits_ = 0;
  int shapes_ = 0;  // geoms that may touch something and are no spheres
  Skeleton skeleton_;
};

}  // namespace

Skeleton read_mjcf(const std::string& path) {
  const MjcfDocument document(path);
  return MjcfReader(document).read();
}

bool is_mjcf(const std::string& path) {
  tinyxml2::XMLDocument document;
  const std::string text = read_text(path);
  return document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS &&
         document.RootElement() != nullptr && std::string(document.RootElement()->Name()) == "mujoco";
}

}  // namespace plumbline::model
