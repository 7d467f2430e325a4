#include "simulator/model/planar_base.h"

#include <cmath>

namespace plumbline::model {
namespace {

constexpr double kRounding = 1e-9;  // of unit vectors

/// Orientations in the world, at zero, of the frames of a slide on the world and of a joint on it.
Eigen::Matrix3d frame_of(const Joint& forward) { return forward.X_PJ.linear(); }
Eigen::Matrix3d frame_of(const Joint& forward, const Joint& upward) {
  return forward.X_PJ.linear() * forward.X_CJ.linear().transpose() * upward.X_PJ.linear();
}

bool carries(const Joint& forward, const Joint& upward) {
  return forward.type == JointType::prismatic && upward.type == JointType::prismatic && forward.parent < 0 &&
         upward.parent == forward.child &&
         std::abs((frame_of(forward) * forward.axis.normalized()).z()) < kRounding &&
         (frame_of(forward, upward) * upward.axis.normalized()).z() > 1.0 - kRounding;
}

}  // namespace

std::optional<PlanarBase> planar_base(const Skeleton& skeleton) {
  const int count = static_cast<int>(skeleton.joints.size());
  for (int f = 0; f < count; ++f) {
    for (int u = 0; u < count; ++u) {
      if (carries(skeleton.joints[static_cast<std::size_t>(f)],
                  skeleton.joints[static_cast<std::size_t>(u)])) {
        return PlanarBase{f, u};
      }
    }
  }
  return std::nullopt;
}

// About the world's up, and about its forward.
void bend_base(Skeleton& skeleton, const PlanarBase& base, double curvature, double level) {
  Joint& forward = skeleton.joints[static_cast<std::size_t>(base.forward)];
  Joint& upward = skeleton.joints[static_cast<std::size_t>(base.upward)];
  const Eigen::Vector3d ahead = frame_of(forward) * forward.axis.normalized();
  forward.arc = {curvature * frame_of(forward).transpose() * Eigen::Vector3d::UnitZ(), 0.0};
  upward.arc = {-curvature * frame_of(forward, upward).transpose() * ahead, level};
}

}  // namespace plumbline::model
