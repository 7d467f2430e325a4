// How the ground's forces on feet change with the state.
#include <algorithm>
#include <cmath>

#include "simulator/model/ground_feet.h"

namespace plumbline::model {

const Eigen::MatrixXd& GroundFeet::jacobian(const FootSlot& slot, const Touch& at, const TreeDynamics& tree) {
  J_.setZero(3, map_.independent());
  for (int k = 0; k < 3; ++k) {
    row_.setZero(map_.tree());
    tree.add_force(slot.body, at.position, Eigen::Vector3d::Unit(k), row_);
    for (int j = 0; j < map_.tree(); ++j) {
      for (const LinearForm::Entry& entry : map_.row(j)) {
        J_(k, entry.index) += entry.value * row_[j];
      }
    }
  }
  return J_;
}

// Adds the ground's own slopes: differences of the laws, no dynamics. Out of the ground bristles straighten,
// and nothing else. Over a motion, where slopes are to be right and not only stable, also what turning the
// leg does to a foot's velocity and to the leverage of its force. A writable view is passed by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void GroundFeet::add_slopes(const TreeDynamics& tree, const double* x, const Values& values,
                            const double* change, Eigen::MatrixXd& slopes, Eigen::Ref<Eigen::MatrixXd> A) {
  if (slots_.empty()) {
    return;
  }
  const Eigen::Index states = A.rows();
  moved_x_ = Eigen::Map<const Eigen::VectorXd>(x, states);
  up_.setZero(states);
  down_.setZero(states);
  SlopesAt by{tree, values, slopes, A};
  for (const FootSlot& slot : slots_) {
    const Touch at = touch(slot, tree);
    jacobian(slot, at, tree);
    V_.resize(3, 0);
    Touch half;
    if (change != nullptr) {
      half.depth = -0.5 * J_.row(2).dot(Eigen::Map<const Eigen::VectorXd>(change, map_.independent()));
      half.velocity.noalias() =
          0.5 * J_ * Eigen::Map<const Eigen::VectorXd>(change + map_.independent(), map_.independent());
      find_turning(slot, at, tree);
    }
    if (at.depth + std::abs(half.depth) > 0.0) {
      add_foot_slopes(slot, at, half, by);
    }
    add_bristle_slopes(slot, at, by);
    if (!slot.turns.empty() && at.depth > 0.0) {
      add_moment_slopes(slot, at, change, by);
    }
    if (change != nullptr) {
      add_leverage_slopes(slot, at, x, by);
    }
  }
}

// How a foot's velocity, in the directions of its link, changes with z while dz/dt is held, and how these
// directions turn: V_ (3 x positions), yaw_ (1 x positions).
void GroundFeet::find_turning(const FootSlot& slot, const Touch& at, const TreeDynamics& tree) {
  Eigen::Matrix3Xd by_joints;
  tree.station_velocity_slope(slot.body, at.position, by_joints);
  if (radius(slot) > 0.0) {
    tree.take_rolling(slot.body, below(slot), by_joints);
  }
  const Eigen::RowVectorXd yaw =
      slot.keeps_axes ? Eigen::RowVectorXd::Zero(map_.tree()) : tree.yaw_slope(slot.body);
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(at.velocity);
  V_.setZero(3, map_.independent());
  yaw_.setZero(map_.independent());
  for (int j = 0; j < map_.tree(); ++j) {
    for (const LinearForm::Entry& entry : map_.row(j)) {
      V_.col(entry.index) += entry.value * (by_joints.col(j) - yaw[j] * across);
      yaw_[entry.index] += entry.value * yaw[j];
    }
  }
}

// What a force that is the same to the link does as it turns with it, and with its leverage.
void GroundFeet::add_leverage_slopes(const FootSlot& slot, const Touch& at, const double* x,
                                     SlopesAt& by) const {
  Touch pressed = at;
  press(slot, x, by.values, pressed, nullptr);
  if (pressed.force.isZero(0.0)) {
    return;
  }
  const Eigen::Vector3d turned = Eigen::Vector3d::UnitZ().cross(pressed.force);
  by.forces.leftCols(map_.independent()).noalias() += (J_.transpose() * turned) * yaw_;
  Eigen::MatrixXd by_joints = Eigen::MatrixXd::Zero(map_.tree(), map_.tree());
  by.tree.add_force_slope(slot.body, pressed.position, pressed.force, by_joints);
  if (radius(slot) > 0.0) {
    by.tree.take_rolling(slot.body, below(slot), pressed.force, by_joints);
  }
  by.forces.leftCols(map_.independent()).noalias() += map_.S_tree().transpose() * by_joints * map_.S_tree();
}

// By depth and by the velocity's three parts, as wide as they change on the way: mean slopes, as in
// force_tangent. By depth no wider, however short the way is: where the foot lands the rate of its bristles
// jumps, from how they straighten to the slip, and counts by the share of the step that lies across.
void GroundFeet::add_foot_slopes(const FootSlot& slot, const Touch& at, const Touch& half, SlopesAt& by) {
  const double* const x = moved_x_.data();
  const double least_depth = std::max(kLeastDepthStep, kShareOfDepth * std::abs(at.depth));
  for (int k = 0; k < 4; ++k) {
    const bool by_depth = k == 3;
    const double step = by_depth ? std::max(least_depth, std::abs(half.depth))
                                 : std::max(kSpeedStep, std::abs(half.velocity[k]));
    Touch plus = at;
    Touch minus = at;
    (by_depth ? plus.depth : plus.velocity[k]) += step;
    (by_depth ? minus.depth : minus.velocity[k]) -= step;
    press(slot, x, by.values, plus, up_.data());
    press(slot, x, by.values, minus, down_.data());
    const double per = (by_depth ? -0.5 : 0.5) / step;  // depth falls where the foot rises
    const Eigen::Vector3d force = per * (plus.force - minus.force);
    const auto add = [&](Eigen::Index column, double share) {
      if (share == 0.0) {
        return;
      }
      by.forces.col(column).noalias() += J_.transpose() * (share * force);
      for (const FootSlot::Drag& use : slot.drags) {
        for (int s = use.state; s >= 0 && s < use.state + use.law->state_count(); ++s) {
          by.rates(s, column) += share * per * (up_[s] - down_[s]);
        }
      }
    };
    for (Eigen::Index i = 0; i < map_.independent(); ++i) {
      add(by_depth ? i : map_.independent() + i, J_(by_depth ? 2 : k, i));
      if (!by_depth && V_.cols() > 0) {
        add(i, V_(k, i));
      }
    }
  }
}

Eigen::Matrix3Xd GroundFeet::turn_jacobian(const FootSlot& slot, const TreeDynamics& tree) const {
  return tree.turn_jacobian(slot.body) * map_.S_tree();
}

// By the turn, as wide as it changes on the way, and by what changes the normal force. Over a motion also
// what turning the leg does to the turn and to the leverage of the moment.
void GroundFeet::add_moment_slopes(const FootSlot& slot, const Touch& at, const double* change,
                                   SlopesAt& by) {
  const double* const x = moved_x_.data();
  const Eigen::Index n = map_.independent();
  const Eigen::Matrix3Xd W = turn_jacobian(slot, by.tree);
  const Eigen::Vector3d half =
      change == nullptr ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                        : Eigen::Vector3d(0.5 * W * Eigen::Map<const Eigen::VectorXd>(change + n, n));
  Eigen::Matrix3Xd turning = Eigen::Matrix3Xd::Zero(3, n);
  if (change != nullptr) {
    Eigen::Matrix3Xd by_joints;
    by.tree.turn_slope(slot.body, by_joints);
    turning = by_joints * map_.S_tree();
  }
  const auto slope = [&](double step, const auto& move) {
    Touch plus = at;
    Touch minus = at;
    move(plus, step);
    move(minus, -step);
    press(slot, x, by.values, plus, nullptr);
    press(slot, x, by.values, minus, nullptr);
    return Eigen::Vector3d((plus.moment - minus.moment) / (2.0 * step));
  };
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd column =
        W.transpose() * slope(std::max(kSpeedStep, std::abs(half[k])),
                              [k](Touch& touch, double step) { touch.turn[k] += step; });
    by.forces.middleCols(n, n) += column * W.row(k);
    by.forces.leftCols(n) += column * turning.row(k);
  }
  const Eigen::VectorXd by_depth =
      W.transpose() * slope(std::max(kLeastDepthStep, kShareOfDepth * std::abs(at.depth)),
                            [](Touch& touch, double step) { touch.depth += step; });
  by.forces.leftCols(n) -= by_depth * J_.row(2);
  const Eigen::VectorXd by_rate =
      W.transpose() * slope(kSpeedStep, [](Touch& touch, double step) { touch.velocity.z() += step; });
  by.forces.middleCols(n, n) += by_rate * J_.row(2);
  if (change == nullptr) {
    return;
  }
  by.forces.leftCols(n) += by_rate * V_.row(2);
  Touch pressed = at;
  press(slot, x, by.values, pressed, nullptr);
  Eigen::MatrixXd by_joints = Eigen::MatrixXd::Zero(map_.tree(), map_.tree());
  by.tree.add_moment_slope(slot.body, pressed.moment, by_joints);
  by.forces.leftCols(n) += map_.S_tree().transpose() * by_joints * map_.S_tree();
}

void GroundFeet::add_bristle_slopes(const FootSlot& slot, const Touch& at, SlopesAt& by) {
  double* const x = moved_x_.data();
  for (const FootSlot::Drag& use : slot.drags) {
    for (int k = use.state; k >= 0 && k < use.state + use.law->state_count(); ++k) {
      const double here = x[k];
      const double step = 1e-7 * (1.0 + std::abs(here));
      Touch plus = at;
      Touch minus = at;
      x[k] = here + step;
      press(slot, x, by.values, plus, up_.data());
      x[k] = here - step;
      press(slot, x, by.values, minus, down_.data());
      x[k] = here;
      const Eigen::Vector3d force = (plus.force - minus.force) / (2.0 * step);
      by.forces.col(k).noalias() += J_.transpose() * force;
      for (const FootSlot::Drag& other : slot.drags) {
        for (int s = other.state; s >= 0 && s < other.state + other.law->state_count(); ++s) {
          by.rates(s, k) += (up_[s] - down_[s]) / (2.0 * step);
        }
      }
    }
  }
}

}  // namespace plumbline::model
