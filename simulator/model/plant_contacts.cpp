// What feet and links of a Plant meet, and how they press.
#include <limits>

#include "simulator/model/plant_dynamics.h"

namespace plumbline::model {

void PlantDynamics::add_links(const double* x, Eigen::VectorXd& Q, double* xdot) {
  on_joints_.setZero(n_tree_);
  links_->add_forces(bodies_.tree(), x, on_ground_, on_joints_, xdot);
  for (int j = 0; j < n_tree_; ++j) {
    for (const LinearForm::Entry& entry : map_.row(j)) {
      Q[entry.index] += entry.value * on_joints_[j];
    }
  }
}

std::vector<Touch> PlantDynamics::touches(const double* x) {
  bodies_.rigid_at(x);
  return feet_.touches(bodies_.tree(), x, on_ground_);
}

std::vector<LinkTouch> PlantDynamics::link_touches(const double* x) {
  std::vector<LinkTouch> all;
  if (links_ != nullptr) {
    bodies_.rigid_at(x);
  }
  for (int point = 0; point < link_points(); ++point) {
    all.push_back(links_->touch(point, bodies_.tree()));
    links_->press(point, x, on_ground_, all.back(), nullptr);
  }
  return all;
}

FootDepth PlantDynamics::foot_depth(int foot, const double* x) {
  const FootSlot* slot = feet_.slot_of(foot);
  if (slot == nullptr) {
    return {-std::numeric_limits<double>::infinity(), 0.0};
  }
  bodies_.rigid_at(x);
  const Touch at = feet_.touch(*slot, bodies_.tree());
  return {at.depth, -at.velocity.z()};
}

Eigen::RowVectorXd PlantDynamics::depth_slope(int foot, const double* x) {
  const FootSlot* slot = feet_.slot_of(foot);
  if (slot == nullptr) {
    return Eigen::RowVectorXd::Zero(nz_);
  }
  bodies_.rigid_at(x);
  const TreeDynamics& tree = bodies_.tree();
  return -feet_.jacobian(*slot, feet_.touch(*slot, tree), tree).row(2);
}

}  // namespace plumbline::model
