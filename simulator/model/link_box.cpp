#include "simulator/model/link_box.h"

#include <cmath>

namespace plumbline::model {
namespace {

Eigen::Vector3d half_lengths(const Body& body) {
  const Eigen::Vector3d moments = body.inertia.diagonal();
  const Eigen::Array3d squares = 1.5 * (moments.sum() - 2.0 * moments.array()) / body.mass;
  return squares.max(0.0).sqrt();
}

}  // namespace

Eigen::AlignedBox3d link_box(const Skeleton& skeleton, int body) {
  const Body& link = skeleton.bodies[static_cast<std::size_t>(body)];
  Eigen::AlignedBox3d box(link.com);
  if (link.mass > 0.0) {
    const Eigen::Vector3d half = half_lengths(link);
    box.extend(link.com + half);
    box.extend(link.com - half);
  }
  for (const Joint& joint : skeleton.joints) {
    if (joint.child == body) {
      box.extend(Eigen::Vector3d(joint.X_CJ.translation()));
    }
    if (joint.parent == body) {
      box.extend(Eigen::Vector3d(joint.X_PJ.translation()));
    }
  }
  return box;
}

}  // namespace plumbline::model
