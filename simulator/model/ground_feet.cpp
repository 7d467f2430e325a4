#include "simulator/model/ground_feet.h"

#include <algorithm>
#include <utility>

#include "simulator/trace/error.h"

namespace plumbline::model {

GroundFeet::GroundFeet(const Model& model, const CoordinateMap& map, contact::Terrain terrain)
    : model_(model), map_(map), terrain_(std::move(terrain)) {}

void GroundFeet::take(const Values& values, int& next_state) {
  for (std::size_t f = 0; f < model_.feet.size(); ++f) {
    const Foot& foot = model_.feet[f];
    FootSlot slot;
    slot.foot = static_cast<int>(f);
    slot.take(
        model_, values, [&](const std::string& at) { return foot.answers_to(at); }, next_state);
    slot.keeps_axes = model_.skeleton.floats() &&
                      std::all_of(slot.drags.begin(), slot.drags.end(), [&](const FootSlot::Drag& use) {
                        return use.law->is_isotropic(values[static_cast<std::size_t>(use.effect)].data());
                      });
    if (!slot.normals.empty()) {
      slots_.push_back(std::move(slot));
    }
  }
}

void GroundFeet::find_links(const Mechanism& mechanism) {
  for (FootSlot& slot : slots_) {
    const Foot& foot = model_.feet[static_cast<std::size_t>(slot.foot)];
    slot.body = mechanism.tree_body(foot.body);
    if (slot.body < 0) {
      throw InputError(model_.file + ": foot " + foot.name +
                       ": found a link that is fixed to the world, expected one that moves");
    }
  }
}

void GroundFeet::change(const Values& stated, Values& changed, ContactLaws::Applied& applied) {
  for (FootSlot& slot : slots_) {
    slot.change(stated, changed, applied);
  }
}

GroundFeet GroundFeet::only(const FootSlot& slot, bool with_drags) const {
  GroundFeet one = *this;
  one.slots_.assign(1, slot);
  if (!with_drags) {
    one.slots_[0].drags.clear();
    one.slots_[0].turns.clear();
  }
  return one;
}

const FootSlot* GroundFeet::slot_of(int foot) const {
  const auto found =
      std::find_if(slots_.begin(), slots_.end(), [&](const FootSlot& slot) { return slot.foot == foot; });
  return found == slots_.end() ? nullptr : &*found;
}

// From a foot's point to what touches level ground.
Eigen::Vector3d GroundFeet::below(const FootSlot& slot) const {
  return -radius(slot) * Eigen::Vector3d::UnitZ();
}

Touch GroundFeet::touch(const FootSlot& slot, const TreeDynamics& tree) const {
  Touch touch;
  touch.position =
      tree.station(slot.body, model_.feet[static_cast<std::size_t>(slot.foot)].point) + below(slot);
  touch.velocity = tree.station_velocity(slot.body, touch.position);
  touch.turn = tree.angular_velocity(slot.body);
  const Eigen::Vector2d left = tree.rotation(slot.body).col(1).head<2>();
  if (!slot.keeps_axes && left.norm() > 1e-3) {  // a link on its side has no left: then the world's
    touch.left = left.normalized();
  }
  touch.depth = terrain_.height_at(touch.position.x()) - touch.position.z() + slot.height;
  return touch;
}

void GroundFeet::press(const FootSlot& slot, const double* x, const Values& values, Touch& touch,
                       double* xdot) const {
  const double rate = -touch.velocity.z();
  const Eigen::Vector2d forward(touch.left.y(), -touch.left.x());
  const Eigen::Vector2d velocity = touch.velocity.head<2>();
  const Eigen::Vector2d slip(forward.dot(velocity), touch.left.dot(velocity));
  const Eigen::Vector3d force = slot.force(touch.depth, rate, slip, x, values, xdot);
  touch.force.setZero();
  touch.force.z() = force.z();
  touch.force.head<2>() += force.x() * forward + force.y() * touch.left;
  touch.moment = slot.moment(touch.turn, force.z(), values);
}

void GroundFeet::add_forces(const TreeDynamics& tree, const double* x, const Values& values,
                            Eigen::VectorXd& Q, double* xdot) {
  if (slots_.empty()) {
    return;
  }
  on_joints_.setZero(map_.tree());
  for (const FootSlot& slot : slots_) {
    Touch at = touch(slot, tree);
    press(slot, x, values, at, xdot);
    if (!at.force.isZero(0.0)) {
      tree.add_force(slot.body, at.position, at.force, on_joints_);
    }
    if (!at.moment.isZero(0.0)) {
      tree.add_moment(slot.body, at.moment, on_joints_);
    }
  }
  for (int j = 0; j < map_.tree(); ++j) {
    for (const LinearForm::Entry& entry : map_.row(j)) {
      Q[entry.index] += entry.value * on_joints_[j];
    }
  }
}

std::vector<Touch> GroundFeet::touches(const TreeDynamics& tree, const double* x,
                                       const Values& values) const {
  std::vector<Touch> all(model_.feet.size());
  for (const FootSlot& slot : slots_) {
    Touch& at = all[static_cast<std::size_t>(slot.foot)];
    at = touch(slot, tree);
    press(slot, x, values, at, nullptr);
  }
  return all;
}

void GroundFeet::add_power(const TreeDynamics& tree, const double* x, const Values& values,
                           Energetics& e) const {
  for (const FootSlot& slot : slots_) {
    Touch at = touch(slot, tree);
    press(slot, x, values, at, nullptr);
    for (const FootSlot::Normal& use : slot.normals) {
      e.stored += use.law->stored_energy(at.depth, values[static_cast<std::size_t>(use.effect)].data());
      e.dissipated += use.law->dissipated_power(at.depth, -at.velocity.z(),
                                                values[static_cast<std::size_t>(use.effect)].data());
    }
    // The energy in bristles scales with the load that presses them and leaves with it; what sliding takes is
    // booked as it goes.
    e.dissipated -= at.force.head<2>().dot(at.velocity.head<2>()) + at.moment.dot(at.turn);
  }
}

}  // namespace plumbline::model
