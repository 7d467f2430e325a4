#include "simulator/model/joint_chain.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

using Eigen::Vector3d;

constexpr const char* kBase = "base";

bool has_joint(const Skeleton& skeleton, const std::string& name) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [&](const Joint& joint) { return joint.name == name; });
}

std::string free_name(const Skeleton& skeleton, std::string name) {
  const auto taken = [&] {
    return std::any_of(skeleton.bodies.begin(), skeleton.bodies.end(),
                       [&](const Body& body) { return body.name == name; });
  };
  while (taken()) {
    name += "_";
  }
  return name;
}

bool on_world(const Joint& joint) { return joint.parent < 0; }

}  // namespace

std::vector<ChainAxis> ball_chain(const std::string& prefix) {
  return {{prefix + "_yaw", JointType::revolute, Vector3d::UnitZ(), false},
          {prefix + "_pitch", JointType::revolute, Vector3d::UnitY(), true},
          {prefix + "_roll", JointType::revolute, Vector3d::UnitX(), false}};
}

std::vector<ChainAxis> free_chain(const std::string& prefix) {
  std::vector<ChainAxis> axes{{prefix + "_x", JointType::prismatic, Vector3d::UnitX(), false},
                              {prefix + "_y", JointType::prismatic, Vector3d::UnitY(), false},
                              {prefix + "_z", JointType::prismatic, Vector3d::UnitZ(), false}};
  for (ChainAxis& turn : ball_chain(prefix)) {
    axes.push_back(std::move(turn));
  }
  return axes;
}

std::vector<ChainAxis> universal_chain(const std::string& prefix, const Vector3d& first,
                                       const Vector3d& second) {
  return {{prefix + "_1", JointType::revolute, first.normalized(), false},
          {prefix + "_2", JointType::revolute, second.normalized(), false}};
}

std::vector<ChainAxis> planar_chain(const std::string& prefix, const Vector3d& normal) {
  const Eigen::Quaterniond onto = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  return {{prefix + "_x", JointType::prismatic, onto * Vector3d::UnitX(), false},
          {prefix + "_y", JointType::prismatic, onto * Vector3d::UnitY(), false},
          {prefix + "_turn", JointType::revolute, normal.normalized(), false}};
}

std::string free_prefix(const Skeleton& skeleton, bool on_world, const std::string& own) {
  return on_world && !has_joint(skeleton, std::string(kBase) + "_x") ? kBase : own;
}

void append_chain(Skeleton& skeleton, const Body& body, const Joint& ends,
                  const std::vector<ChainAxis>& axes) {
  const bool floats = axes.size() == 6;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const bool last = i + 1 == axes.size();
    Joint joint;
    joint.name = axes[i].name;
    joint.type = axes[i].type;
    joint.axis = axes[i].axis;
    joint.floats = floats;
    joint.parent = i == 0 ? ends.parent : static_cast<int>(skeleton.bodies.size()) - 1;
    joint.X_PJ = i == 0 ? ends.X_PJ : Eigen::Isometry3d::Identity();
    joint.X_CJ = last ? ends.X_CJ : Eigen::Isometry3d::Identity();
    joint.child = static_cast<int>(skeleton.bodies.size());
    if (axes[i].is_pitch) {
      skeleton.charts.push_back(static_cast<int>(skeleton.joints.size()));
    }
    Body between;
    if (!last) {
      between.name = free_name(skeleton, body.name + "_of_" + joint.name);
      between.is_between = true;
    }
    skeleton.bodies.push_back(last ? body : between);
    skeleton.joints.push_back(std::move(joint));
  }
}

bool free_base(Skeleton& skeleton) {
  const auto first = std::find_if(skeleton.joints.begin(), skeleton.joints.end(), on_world);
  if (std::count_if(skeleton.joints.begin(), skeleton.joints.end(), on_world) != 1 ||
      first->type != JointType::fixed || first != skeleton.joints.begin()) {
    return false;
  }
  Skeleton floating = skeleton;
  floating.bodies.clear();
  floating.joints.clear();
  floating.charts.clear();
  Joint ends;
  ends.parent = -1;
  const Body root = skeleton.bodies[static_cast<std::size_t>(first->child)];
  append_chain(floating, root, ends, free_chain(kBase));
  const int moved = static_cast<int>(floating.bodies.size()) - 1;
  for (std::size_t j = 1; j < skeleton.joints.size(); ++j) {
    Joint joint = skeleton.joints[j];
    joint.parent += moved;
    joint.child += moved;
    floating.bodies.push_back(skeleton.bodies[j]);
    floating.joints.push_back(std::move(joint));
  }
  for (const int chart : skeleton.charts) {
    floating.charts.push_back(chart + moved);
  }
  for (ContactSphere& sphere : floating.spheres) {
    sphere.body += moved;
  }
  skeleton = std::move(floating);
  return true;
}

void check_joint_names(const Skeleton& skeleton) {
  std::set<std::string> names;
  for (const Joint& joint : skeleton.joints) {
    if (!names.insert(joint.name).second) {
      throw InputError({skeleton.file, 0, joint.name},
                       "two joints of this name (a free joint's are base_x, base_y, base_z, base_yaw, "
                       "base_pitch and base_roll)",
                       "each name once");
    }
  }
}

std::string chart_refusal(const std::string& joint, double pitch, double least) {
  if (std::abs(std::cos(pitch)) >= least) {
    return "";
  }
  return joint + ": found a pitch of " + number_text(pitch, 4) + " rad, expected |cos(pitch)| of at least " +
         number_text(least) +
         ": nearer to +-90 degrees yaw and roll are one turn; turn the link's frame in the skeleton so that "
         "its x axis stays away from the vertical";
}

}  // namespace plumbline::model
