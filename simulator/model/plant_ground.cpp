// Feet of a Plant on the ground.
#include <algorithm>
#include <cmath>

#include "simulator/model/plant.h"
#include "simulator/trace/error.h"

namespace plumbline::model {

namespace {

constexpr double kDepthStep = 1e-8;  // m
constexpr double kSpeedStep = 1e-4;  // m/s: the root of a speed has no slope at rest

}  // namespace

void Plant::place_ground(int& next_state) {
  for (std::size_t f = 0; f < model_.feet.size(); ++f) {
    const Foot& foot = model_.feet[f];
    FootSlot slot;
    slot.foot = static_cast<int>(f);
    for (int e = 0; e < static_cast<int>(model_.effects.size()); ++e) {
      const EffectUse& use = model_.effects[static_cast<std::size_t>(e)];
      if (use.at != foot.name || use.law->is_null(values(e))) {
        continue;
      }
      if (const auto* normal = dynamic_cast<const contact::NormalLaw*>(use.law.get())) {
        slot.normals.push_back({normal, e});
      } else if (const auto* drag = dynamic_cast<const contact::TangentialLaw*>(use.law.get())) {
        slot.drags.push_back({drag, e, drag->state_count() > 0 ? next_state : -1});
        next_state += drag->state_count();
      }
    }
    if (!slot.normals.empty()) {
      feet_.push_back(std::move(slot));
    }
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

Touch Plant::touch(const FootSlot& slot) const {
  const TreeDynamics& tree = structure_.mechanism->tree();
  Touch touch;
  touch.position = tree.station(slot.body, model_.feet[static_cast<std::size_t>(slot.foot)].point);
  touch.velocity = tree.station_velocity(slot.body, touch.position);
  const Eigen::Vector2d left = tree.rotation(slot.body).col(1).head<2>();
  if (left.norm() > 1e-3) {  // a link on its side has no left: then the world's
    touch.left = left.normalized();
  }
  touch.depth = terrain_.height_at(touch.position.x()) - touch.position.z();
  return touch;
}

void Plant::press(const FootSlot& slot, const double* x, Touch& touch, double* xdot) const {
  const double rate = -touch.velocity.z();
  const Eigen::Vector2d forward(touch.left.y(), -touch.left.x());
  const Eigen::Vector2d velocity = touch.velocity.head<2>();
  const Eigen::Vector2d slip(forward.dot(velocity), touch.left.dot(velocity));
  touch.force.setZero();
  for (const FootSlot::Normal& use : slot.normals) {
    touch.force.z() += use.law->force(touch.depth, rate, values(use.effect));
  }
  for (const FootSlot::Drag& use : slot.drags) {
    const double* state = use.state >= 0 ? x + use.state : nullptr;
    const Eigen::Vector2d drag = use.law->force(slip, touch.force.z(), state, values(use.effect));
    touch.force.head<2>() += drag.x() * forward + drag.y() * touch.left;
    if (xdot != nullptr && use.state >= 0) {
      use.law->state_rate(slip, touch.force.z(), state, values(use.effect), xdot + use.state);
    }
  }
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
  Q.noalias() += S_tree_.transpose() * ground_;
}

// d(foot's velocity)/d(dz/dt), 3 x positions.
Eigen::MatrixXd Plant::foot_jacobian(const FootSlot& slot, const Touch& at) const {
  Eigen::MatrixXd J(3, nz_);
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n_tree_);
    structure_.mechanism->tree().add_force(slot.body, at.position, Eigen::Vector3d::Unit(k), row);
    J.row(k) = (S_tree_.transpose() * row).transpose();
  }
  return J;
}

// Adds the ground's own slopes: differences of the laws, no dynamics, the foot's place on the link held.
void Plant::ground_tangent(const double* x, Eigen::Ref<Eigen::MatrixXd> A) {
  Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(x, nx_);
  Eigen::VectorXd up = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd down = up;
  for (const FootSlot& slot : feet_) {
    const Touch at = touch(slot);
    const Eigen::MatrixXd J = foot_jacobian(slot, at);
    const Eigen::MatrixXd push = factor_.solve(J.transpose());
    // One input of the laws is moved to either side; its slopes go to the columns that the input depends on.
    const auto slope = [&](const auto& move, double step) {
      Touch plus = at;
      Touch minus = at;
      up.setZero();
      down.setZero();
      move(plus, step);
      press(slot, state.data(), plus, up.data());
      move(plus, 0.0);
      move(minus, -step);
      press(slot, state.data(), minus, down.data());
      move(minus, 0.0);
      Eigen::VectorXd column = (up - down) / (2.0 * step);
      column.segment(nz_, nz_) = push * ((plus.force - minus.force) / (2.0 * step));
      return column;
    };
    if (at.depth > 0.0) {
      A.leftCols(nz_) -= slope([](Touch& touch, double step) { touch.depth += step; }, kDepthStep) * J.row(2);
    }
    for (int k = 0; k < 3; ++k) {
      A.middleCols(nz_, nz_) +=
          slope([k](Touch& touch, double step) { touch.velocity[k] += step; }, kSpeedStep) * J.row(k);
    }
    for (const FootSlot::Drag& use : slot.drags) {
      for (int k = use.state; k >= 0 && k < use.state + use.law->state_count(); ++k) {
        const double here = state[k];
        A.col(k) +=
            slope([&](Touch&, double step) { state[k] = here + step; }, 1e-7 * (1.0 + std::abs(here)));
      }
    }
  }
}

void Plant::ground_energetics(const double* x, Energetics& e) const {
  for (const FootSlot& slot : feet_) {
    Touch at = touch(slot);
    press(slot, x, at, nullptr);
    for (const FootSlot::Normal& use : slot.normals) {
      e.stored += use.law->stored_energy(at.depth, values(use.effect));
      e.dissipated += use.law->dissipated_power(at.depth, -at.velocity.z(), values(use.effect));
    }
    // The energy in bristles scales with the load that presses them and leaves with it; what sliding takes is
    // booked as it goes.
    e.dissipated -= at.force.head<2>().dot(at.velocity.head<2>());
  }
}

std::vector<Touch> Plant::touches(const double* x) {
  evaluate_rigid(x, structure_, M_, h_);
  std::vector<Touch> all(model_.feet.size());
  for (const FootSlot& slot : feet_) {
    Touch& at = all[static_cast<std::size_t>(slot.foot)];
    at = touch(slot);
    press(slot, x, at, nullptr);
  }
  return all;
}

}  // namespace plumbline::model
