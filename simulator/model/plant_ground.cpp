// Feet of a Plant on the ground.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulator/model/plant.h"
#include "simulator/trace/error.h"

namespace plumbline::model {

namespace {

constexpr double kBaseStep = 1e-6;  // 1/m or m

}  // namespace

void Plant::place_ground(int& next_state) {
  for (std::size_t f = 0; f < model_.feet.size(); ++f) {
    const Foot& foot = model_.feet[f];
    FootSlot slot;
    slot.foot = static_cast<int>(f);
    slot.take(
        model_, values_, [&](const std::string& at) { return foot.answers_to(at); }, next_state);
    slot.keeps_axes = model_.skeleton.floats() &&
                      std::all_of(slot.drags.begin(), slot.drags.end(), [&](const FootSlot::Drag& use) {
                        return use.law->is_isotropic(values(use.effect));
                      });
    if (!slot.normals.empty()) {
      feet_.push_back(std::move(slot));
    }
  }
  place_links(next_state);
  change_ground();
}

void Plant::change_ground() {
  if (feet_.empty() && links_ == nullptr) {
    return;
  }
  on_ground_ = values_;
  ContactLaws::Applied applied;
  for (FootSlot& slot : feet_) {
    slot.change(values_, on_ground_, applied);
  }
  if (links_ != nullptr) {
    links_->change(values_, on_ground_, applied);
  }
}

void Plant::find_feet() {
  for (FootSlot& slot : feet_) {
    const Foot& foot = model_.feet[static_cast<std::size_t>(slot.foot)];
    slot.body = structure_.mechanism->tree_body(foot.body);
    if (slot.body < 0) {
      throw InputError(model_.file + ": foot " + foot.name +
                       ": found a link that is fixed to the world, expected one that moves");
    }
  }
}

// From a foot's point to what touches level ground.
Eigen::Vector3d Plant::below(const FootSlot& slot) const {
  return -model_.feet[static_cast<std::size_t>(slot.foot)].radius * Eigen::Vector3d::UnitZ();
}

Touch Plant::touch(const FootSlot& slot) const {
  const TreeDynamics& tree = structure_.mechanism->tree();
  Touch touch;
  touch.position =
      tree.station(slot.body, model_.feet[static_cast<std::size_t>(slot.foot)].point) + below(slot);
  touch.velocity = tree.station_velocity(slot.body, touch.position);
  const Eigen::Vector2d left = tree.rotation(slot.body).col(1).head<2>();
  if (!slot.keeps_axes && left.norm() > 1e-3) {  // a link on its side has no left: then the world's
    touch.left = left.normalized();
  }
  touch.depth = terrain_.height_at(touch.position.x()) - touch.position.z() + slot.height;
  return touch;
}

void Plant::press(const FootSlot& slot, const double* x, Touch& touch, double* xdot) const {
  const double rate = -touch.velocity.z();
  const Eigen::Vector2d forward(touch.left.y(), -touch.left.x());
  const Eigen::Vector2d velocity = touch.velocity.head<2>();
  const Eigen::Vector2d slip(forward.dot(velocity), touch.left.dot(velocity));
  const Eigen::Vector3d force = slot.force(touch.depth, rate, slip, x, on_ground_, xdot);
  touch.force.setZero();
  touch.force.z() = force.z();
  touch.force.head<2>() += force.x() * forward + force.y() * touch.left;
}

void Plant::add_ground(const double* x, Eigen::VectorXd& Q, double* xdot) {
  if (feet_.empty()) {
    return;
  }
  ground_.setZero(n_tree_);
  for (const FootSlot& slot : feet_) {
    Touch at = touch(slot);
    press(slot, x, at, xdot);
    if (!at.force.isZero(0.0)) {
      structure_.mechanism->tree().add_force(slot.body, at.position, at.force, ground_);
    }
  }
  for (int j = 0; j < n_tree_; ++j) {
    for (const Entry& entry : S_rows_[static_cast<std::size_t>(j)]) {
      Q[entry.index] += entry.value * ground_[j];
    }
  }
}

// d(foot's velocity)/d(dz/dt), 3 x positions.
const Eigen::MatrixXd& Plant::foot_jacobian(const FootSlot& slot, const Touch& at) {
  foot_J_.setZero(3, nz_);
  for (int k = 0; k < 3; ++k) {
    foot_row_.setZero(n_tree_);
    structure_.mechanism->tree().add_force(slot.body, at.position, Eigen::Vector3d::Unit(k), foot_row_);
    for (int j = 0; j < n_tree_; ++j) {
      for (const Entry& entry : S_rows_[static_cast<std::size_t>(j)]) {
        foot_J_(k, entry.index) += entry.value * foot_row_[j];
      }
    }
  }
  return foot_J_;
}

// Adds the ground's own slopes: differences of the laws, no dynamics. Forces go to slopes_, rates of bristles
// to A. Out of the ground bristles straighten, and nothing else. Over a motion, where slopes are to be right
// and not only stable, also what turning the leg does to a foot's velocity and to the leverage of its force.
// A writable view is passed by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void Plant::ground_tangent(const double* x, const double* change, Eigen::Ref<Eigen::MatrixXd> A) {
  if (feet_.empty()) {
    return;
  }
  moved_x_ = Eigen::Map<const Eigen::VectorXd>(x, nx_);
  up_.setZero(nx_);
  down_.setZero(nx_);
  for (const FootSlot& slot : feet_) {
    const Touch at = touch(slot);
    foot_jacobian(slot, at);
    foot_V_.resize(3, 0);
    Touch half;
    if (change != nullptr) {
      half.depth = -0.5 * foot_J_.row(2).dot(Eigen::Map<const Eigen::VectorXd>(change, nz_));
      half.velocity.noalias() = 0.5 * foot_J_ * Eigen::Map<const Eigen::VectorXd>(change + nz_, nz_);
      find_turning(slot, at);
    }
    if (at.depth + std::abs(half.depth) > 0.0) {
      foot_tangent(slot, at, half, moved_x_.data(), A);
    }
    bristle_tangent(slot, at, moved_x_.data(), A);
    if (change != nullptr) {
      leverage_tangent(slot, at, x);
    }
  }
}

// How a foot's velocity, in the directions of its link, changes with z while dz/dt is held, and how these
// directions turn: foot_V_ (3 x positions), foot_yaw_ (1 x positions).
void Plant::find_turning(const FootSlot& slot, const Touch& at) {
  const TreeDynamics& tree = structure_.mechanism->tree();
  Eigen::Matrix3Xd by_joints;
  tree.station_velocity_slope(slot.body, at.position, by_joints);
  if (model_.feet[static_cast<std::size_t>(slot.foot)].radius > 0.0) {
    tree.take_rolling(slot.body, below(slot), by_joints);
  }
  const Eigen::RowVectorXd yaw =
      slot.keeps_axes ? Eigen::RowVectorXd::Zero(n_tree_) : tree.yaw_slope(slot.body);
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(at.velocity);
  foot_V_.setZero(3, nz_);
  foot_yaw_.setZero(nz_);
  for (int j = 0; j < n_tree_; ++j) {
    for (const Entry& entry : S_rows_[static_cast<std::size_t>(j)]) {
      foot_V_.col(entry.index) += entry.value * (by_joints.col(j) - yaw[j] * across);
      foot_yaw_[entry.index] += entry.value * yaw[j];
    }
  }
}

// What a force that is the same to the link does as it turns with it, and with its leverage.
void Plant::leverage_tangent(const FootSlot& slot, const Touch& at, const double* x) {
  Touch pressed = at;
  press(slot, x, pressed, nullptr);
  if (pressed.force.isZero(0.0)) {
    return;
  }
  const Eigen::Vector3d turned = Eigen::Vector3d::UnitZ().cross(pressed.force);
  slopes_.leftCols(nz_).noalias() += (foot_J_.transpose() * turned) * foot_yaw_;
  Eigen::MatrixXd by_joints = Eigen::MatrixXd::Zero(n_tree_, n_tree_);
  const TreeDynamics& tree = structure_.mechanism->tree();
  tree.add_force_slope(slot.body, pressed.position, pressed.force, by_joints);
  if (model_.feet[static_cast<std::size_t>(slot.foot)].radius > 0.0) {
    tree.take_rolling(slot.body, below(slot), pressed.force, by_joints);
  }
  slopes_.leftCols(nz_).noalias() += S_tree_.transpose() * by_joints * S_tree_;
}

// By depth and by the velocity's three parts, as wide as they change on the way: mean slopes, as in
// force_tangent. By depth no wider, however short the way is: where the foot lands the rate of its bristles
// jumps, from how they straighten to the slip, and counts by the share of the step that lies across.
void Plant::foot_tangent(const FootSlot& slot, const Touch& at, const Touch& half, double* x,
                         Eigen::Ref<Eigen::MatrixXd> A) {
  const double least_depth = std::max(kLeastDepthStep, kShareOfDepth * std::abs(at.depth));
  for (int k = 0; k < 4; ++k) {
    const bool by_depth = k == 3;
    const double step = by_depth ? std::max(least_depth, std::abs(half.depth))
                                 : std::max(kSpeedStep, std::abs(half.velocity[k]));
    Touch plus = at;
    Touch minus = at;
    (by_depth ? plus.depth : plus.velocity[k]) += step;
    (by_depth ? minus.depth : minus.velocity[k]) -= step;
    press(slot, x, plus, up_.data());
    press(slot, x, minus, down_.data());
    const double per = (by_depth ? -0.5 : 0.5) / step;  // depth falls where the foot rises
    const Eigen::Vector3d force = per * (plus.force - minus.force);
    const auto add = [&](Eigen::Index column, double share) {
      if (share == 0.0) {
        return;
      }
      slopes_.col(column).noalias() += foot_J_.transpose() * (share * force);
      for (const FootSlot::Drag& use : slot.drags) {
        for (int s = use.state; s >= 0 && s < use.state + use.law->state_count(); ++s) {
          A(s, column) += share * per * (up_[s] - down_[s]);
        }
      }
    };
    for (Eigen::Index i = 0; i < nz_; ++i) {
      add(by_depth ? i : nz_ + i, foot_J_(by_depth ? 2 : k, i));
      if (!by_depth && foot_V_.cols() > 0) {
        add(i, foot_V_(k, i));
      }
    }
  }
}

void Plant::bristle_tangent(const FootSlot& slot, const Touch& at, double* x, Eigen::Ref<Eigen::MatrixXd> A) {
  for (const FootSlot::Drag& use : slot.drags) {
    for (int k = use.state; k >= 0 && k < use.state + use.law->state_count(); ++k) {
      const double here = x[k];
      const double step = 1e-7 * (1.0 + std::abs(here));
      Touch plus = at;
      Touch minus = at;
      x[k] = here + step;
      press(slot, x, plus, up_.data());
      x[k] = here - step;
      press(slot, x, minus, down_.data());
      x[k] = here;
      const Eigen::Vector3d force = (plus.force - minus.force) / (2.0 * step);
      slopes_.col(k).noalias() += foot_J_.transpose() * force;
      for (const FootSlot::Drag& other : slot.drags) {
        for (int s = other.state; s >= 0 && s < other.state + other.law->state_count(); ++s) {
          A(s, k) += (up_[s] - down_[s]) / (2.0 * step);
        }
      }
    }
  }
}

void Plant::ground_energetics(const double* x, Energetics& e) const {
  for (const FootSlot& slot : feet_) {
    Touch at = touch(slot);
    press(slot, x, at, nullptr);
    for (const FootSlot::Normal& use : slot.normals) {
      e.stored += use.law->stored_energy(at.depth, on_ground(use.effect));
      e.dissipated += use.law->dissipated_power(at.depth, -at.velocity.z(), on_ground(use.effect));
    }
    // The energy in bristles scales with the load that presses them and leaves with it; what sliding takes is
    // booked as it goes.
    e.dissipated -= at.force.head<2>().dot(at.velocity.head<2>());
  }
}

std::vector<Touch> Plant::touches(const double* x) {
  rigid_at(x);
  std::vector<Touch> all(model_.feet.size());
  for (const FootSlot& slot : feet_) {
    Touch& at = all[static_cast<std::size_t>(slot.foot)];
    at = touch(slot);
    press(slot, x, at, nullptr);
  }
  return all;
}

const Plant::FootSlot* Plant::slot_of(int foot) const {
  const auto found =
      std::find_if(feet_.begin(), feet_.end(), [&](const FootSlot& slot) { return slot.foot == foot; });
  return found == feet_.end() ? nullptr : &*found;
}

FootDepth Plant::foot_depth(int foot, const double* x) {
  const FootSlot* slot = slot_of(foot);
  if (slot == nullptr) {
    return {-std::numeric_limits<double>::infinity(), 0.0};
  }
  rigid_at(x);
  const Touch at = touch(*slot);
  return {at.depth, -at.velocity.z()};
}

Eigen::RowVectorXd Plant::depth_slope(int foot, const double* x) {
  const FootSlot* slot = slot_of(foot);
  if (slot == nullptr) {
    return Eigen::RowVectorXd::Zero(nz_);
  }
  rigid_at(x);
  return -foot_jacobian(*slot, touch(*slot)).row(2);
}

// By what raises the ground, and by what carries the foot elsewhere.
Eigen::RowVectorXd Plant::depth_slope(int foot, const double* x, const std::vector<ParameterId>& parameters) {
  Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  const FootSlot* slot = slot_of(foot);
  for (std::size_t p = 0; slot != nullptr && p < parameters.size(); ++p) {
    double& here = slope[static_cast<Eigen::Index>(p)];
    for (const FootSlot::Change& use : slot->changes) {
      if (use.effect == parameters[p].effect) {
        effects::Values unit(values_[static_cast<std::size_t>(use.effect)].size(), 0.0);
        const double before = use.law->change(unit.data()).height;
        unit[static_cast<std::size_t>(parameters[p].parameter)] = 1.0;
        here = use.law->change(unit.data()).height - before;
      }
    }
    if (sits_at_base(parameters[p].effect)) {
      const double before = foot_depth(foot, x).depth;
      Variant& variant = variant_of(parameters[p], kBaseStep);
      std::swap(structure_, variant.structure);
      rigid_known_ = false;
      here = (foot_depth(foot, x).depth - before) / variant.step;
      std::swap(structure_, variant.structure);
      rigid_known_ = false;
    }
  }
  return slope;
}

// The foot is where rate() has left it. Adds to the column.
void Plant::ground_parameter_tangent(const FootSlot& slot, const double* x, ParameterId id, double step,
                                     effects::Values moved, Eigen::Ref<Eigen::VectorXd> column) {
  effects::Values& stored = values_[static_cast<std::size_t>(id.effect)];
  Eigen::VectorXd now = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd up = now;
  Touch before = touch(slot);
  press(slot, x, before, now.data());
  std::swap(stored, moved);
  change_ground();
  Touch after = touch(slot);
  press(slot, x, after, up.data());
  std::swap(stored, moved);
  change_ground();
  column += (up - now) / step;
  column.segment(nz_, nz_) +=
      accelerated(foot_jacobian(slot, before).transpose() * ((after.force - before.force) / step));
}

}  // namespace plumbline::model
