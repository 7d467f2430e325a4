#include "simulator/render/sticks.h"

#include <algorithm>

namespace plumbline::render {
namespace {

constexpr double kShortest = 0.01;  // m

/// What a body carries, in its frame: joints, then feet.
std::vector<Eigen::Vector3d> ends_of(const model::Model& model, int body) {
  std::vector<Eigen::Vector3d> ends;
  for (const model::Joint& joint : model.skeleton.joints) {
    if (joint.parent == body) {
      ends.emplace_back(joint.X_PJ.translation());
    }
  }
  for (const model::Foot& foot : model.feet) {
    if (foot.body == body) {
      ends.push_back(foot.point);
    }
  }
  return ends;
}

bool is_fixed_to_world(const model::Joint& joint) {
  return joint.parent < 0 && joint.type == model::JointType::fixed;
}

}  // namespace

std::vector<Stick> sticks_of(const model::Model& model) {
  std::vector<Stick> sticks;
  for (std::size_t b = 0; b < model.skeleton.bodies.size(); ++b) {
    const model::Joint& joint = model.skeleton.joints[b];
    const int body = static_cast<int>(b);
    const Eigen::Vector3d from = joint.X_CJ.translation();
    double reach = 0.0;
    for (const Eigen::Vector3d& to : ends_of(model, body)) {
      reach = std::max(reach, (to - from).norm());
      if ((to - from).norm() > kShortest) {
        sticks.push_back({body, from, to});
      }
    }
    const Eigen::Vector3d to_center = model.skeleton.bodies[b].com - from;
    const bool beyond = model.skeleton.bodies[b].mass > 0.0 && to_center.norm() > std::max(reach, kShortest);
    if (beyond && !is_fixed_to_world(joint)) {
      sticks.push_back({body, from, from + 2.0 * to_center});
    }
  }
  return sticks;
}

std::vector<Eigen::Vector3d> main_directions(const model::Skeleton& skeleton,
                                             const std::vector<Stick>& sticks) {
  std::vector<Eigen::Vector3d> directions(skeleton.bodies.size(), Eigen::Vector3d::Zero());
  for (const Stick& stick : sticks) {
    Eigen::Vector3d& best = directions[static_cast<std::size_t>(stick.body)];
    const Eigen::Vector3d half = 0.5 * (stick.to - stick.from);
    best = half.norm() > best.norm() ? half : best;
  }
  return directions;
}

}  // namespace plumbline::render
