#include "simulator/model/mjcf_equality.h"

#include <algorithm>
#include <vector>

#include "simulator/model/body_poses.h"
#include "simulator/model/joint_ties.h"
#include "simulator/model/mjcf_values.h"
#include "simulator/trace/error.h"

namespace plumbline::model {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

bool is_active(const XMLElement& element, const MjcfDefaults& defaults) {
  const char* active = defaults.attribute(element, "active", "");
  return active == nullptr || std::string(active) != "false";
}

class MjcfLoops : private MjcfValues {
 public:
  MjcfLoops(const MjcfDocument& document, Skeleton& skeleton) : MjcfValues(document), skeleton_(skeleton) {
    std::vector<double> file_pose;
    for (const Joint& joint : skeleton.joints) {
      if (joint.type != JointType::fixed) {
        file_pose.push_back(joint.reference);
      }
    }
    poses_ = body_poses(
        skeleton, Eigen::Map<Eigen::VectorXd>(file_pose.data(), static_cast<Eigen::Index>(file_pose.size())));
  }

  void read(const XMLElement& element) {
    if (!is_active(element, defaults_)) {
      return;
    }
    const char* name = element.Attribute("name");
    Loop loop;
    loop.name = name != nullptr
                    ? name
                    : std::string(element.Name()) + "_" + std::to_string(skeleton_.loops.size() + 1);
    const Place_in_file place = source_.place(element);
    loop.file = place.file;
    loop.line = place.line;
    const int first = body_of(element, "body1", true);
    const int second = body_of(element, "body2", false);
    refuse_if_it_floats(element, first, second);
    const Isometry3d between = pose_of(second).inverse() * pose_of(first);  // X_21
    if (std::string(element.Name()) == "connect") {
      const char* anchor = element.Attribute("anchor");
      if (anchor == nullptr) {
        refuse(element, "no anchor", "the point in the frame of body1");
      }
      const Vector3d point = vector(element, anchor, "anchor");
      loop.type = Loop::Type::connect;
      loop.ends = {LoopEnd{first, point}, LoopEnd{second, between * point}};
    } else {
      const Isometry3d second_in_first = relative_pose(element, between.inverse());
      loop.type = Loop::Type::weld;
      loop.ends = {LoopEnd{first, second_in_first.translation(), second_in_first.linear()}, LoopEnd{second}};
    }
    skeleton_.loops.push_back(std::move(loop));
  }

 private:
  int body_of(const XMLElement& element, const char* which, bool needed) const {
    const char* name = element.Attribute(which);
    if (name == nullptr) {
      if (needed) {
        refuse(element, std::string("no ") + which, "two bodies, body1 and body2 (sites are not read)");
      }
      return -1;
    }
    std::vector<std::string> names{"world"};
    for (std::size_t b = 0; b < skeleton_.bodies.size(); ++b) {
      if (skeleton_.bodies[b].name == name) {
        return static_cast<int>(b);
      }
      names.push_back(skeleton_.bodies[b].name);
    }
    if (names.front() != name) {
      refuse(element, std::string(which) + "=\"" + name + "\"",
             "the name of a body" + nearest_names(name, names));
    }
    return -1;
  }

  Isometry3d pose_of(int body) const {
    return body < 0 ? Isometry3d::Identity() : poses_[static_cast<std::size_t>(body)];
  }

  /// The body of a chain to the world that hangs on it, and whether a free joint is on the way.
  struct Root {
    int body = -1;
    bool floats = false;
  };
  Root root_of(int body) const {
    Root root;
    for (; body >= 0; body = skeleton_.joints[static_cast<std::size_t>(body)].parent) {
      root.body = body;
      root.floats = root.floats || skeleton_.joints[static_cast<std::size_t>(body)].floats;
    }
    return root;
  }

  void refuse_if_it_floats(const XMLElement& element, int first, int second) const {
    const Root one = root_of(first);
    const Root other = root_of(second);
    if (one.body != other.body && (one.floats || other.floats)) {
      refuse(element, "a loop between a body that floats and one that does not hang on it",
             "both points stated under `loops` of the model file");
    }
  }

  Isometry3d relative_pose(const XMLElement& element, const Isometry3d& of_file) const {
    const char* text = element.Attribute("relpose");
    if (text == nullptr) {
      return of_file;
    }
    const std::vector<double> v = numbers(element, text, "relpose");
    if (v.size() != 7) {
      refuse(element, "relpose=\"" + std::string(text) + "\"", "seven numbers: position and quaternion");
    }
    const Eigen::Quaterniond turn(v[3], v[4], v[5], v[6]);
    if (!(turn.norm() > 0.0)) {
      return of_file;  // MuJoCo's way to ask for it
    }
    Isometry3d X = Isometry3d::Identity();
    X.linear() = turn.normalized().toRotationMatrix();
    X.translation() = Vector3d(v[0], v[1], v[2]);
    return X;
  }

  Skeleton& skeleton_;
  std::vector<Isometry3d> poses_;
};

class MjcfTies : private MjcfValues {
 public:
  MjcfTies(const MjcfDocument& document, const Skeleton& skeleton)
      : MjcfValues(document), skeleton_(skeleton) {}

  const std::vector<JointTie>& all() const { return ties_; }

  void read(const XMLElement& element) {
    if (!is_active(element, defaults_)) {
      return;
    }
    const Joint& joint = joint_of(element, "joint1");
    const Joint* to = element.Attribute("joint2") != nullptr ? &joint_of(element, "joint2") : nullptr;
    const char* text = defaults_.attribute(element, "polycoef", "");
    std::vector<double> a = numbers(element, text != nullptr ? text : "0 1 0 0 0", "polycoef");
    a.resize(std::max<std::size_t>(a.size(), 2), 0.0);
    if (to != nullptr && std::any_of(a.begin() + 2, a.end(), [](double value) { return value != 0.0; })) {
      refuse(element, "polycoef=\"" + std::string(text) + "\"", "a line: two coefficients, the others 0");
    }
    const double zero = to != nullptr ? a[0] - a[1] * to->reference : a[0];
    ties_.push_back(
        {joint.name, to != nullptr ? to->name : "", a[1], joint.reference + zero, source_.place(element)});
  }

 private:
  const Joint& joint_of(const XMLElement& element, const char* which) const {
    const char* name = element.Attribute(which);
    std::vector<std::string> names;
    for (const Joint& joint : skeleton_.joints) {
      if (joint.type == JointType::fixed) {
        continue;
      }
      if (name != nullptr && joint.name == name) {
        return joint;
      }
      names.push_back(joint.name);
    }
    refuse(element, name == nullptr ? std::string("no ") + which : which + ("=\"" + std::string(name)) + "\"",
           "the name of a hinge or slide" + (name == nullptr ? "" : nearest_names(name, names)));
  }

  const Skeleton& skeleton_;
  std::vector<JointTie> ties_;
};

}  // namespace

bool is_mjcf_equality(const XMLElement& element) {
  const std::string kind = element.Name();
  return kind == "connect" || kind == "weld" || kind == "joint";
}

void read_mjcf_equalities(const MjcfDocument& document, Skeleton& skeleton) {
  MjcfLoops loops(document, skeleton);
  MjcfTies ties(document, skeleton);
  for (const XMLElement* section : document.sections("equality")) {
    for (const XMLElement* one = section->FirstChildElement(); one != nullptr;
         one = one->NextSiblingElement()) {
      if (std::string(one->Name()) == "joint") {
        ties.read(*one);
      } else if (is_mjcf_equality(*one)) {
        loops.read(*one);
      }
    }
  }
  tie_joints(ties.all(), skeleton);
}

}  // namespace plumbline::model
