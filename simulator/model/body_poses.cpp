#include "simulator/model/body_poses.h"

namespace plumbline::model {
namespace {

Eigen::Isometry3d moved(const Joint& joint, double q) {
  if (joint.type == JointType::prismatic) {
    return slid(joint.axis.normalized(), joint.arc, q);
  }
  Eigen::Isometry3d J = Eigen::Isometry3d::Identity();
  J.linear() = Eigen::AngleAxisd(q, joint.axis.normalized()).toRotationMatrix();
  return J;
}

}  // namespace

std::vector<Eigen::Isometry3d> body_poses(const Skeleton& skeleton, const Eigen::VectorXd& q) {
  std::vector<Eigen::Isometry3d> poses(skeleton.bodies.size(), Eigen::Isometry3d::Identity());
  Eigen::Index next = 0;
  for (const Joint& joint : skeleton.joints) {
    Eigen::Isometry3d X = joint.X_PJ;
    if (joint.parent >= 0) {
      X = poses[static_cast<std::size_t>(joint.parent)] * X;
    }
    if (joint.type != JointType::fixed) {
      X = X * moved(joint, q[next++]);
    }
    poses[static_cast<std::size_t>(joint.child)] = X * joint.X_CJ.inverse();
  }
  return poses;
}

}  // namespace plumbline::model
