#include "simulator/model/link_contacts.h"

#include <algorithm>
#include <utility>

#include "simulator/model/body_poses.h"

namespace plumbline::model {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d velocity_of(int body, const Vector3d& p_W, const TreeDynamics& tree) {
  return body < 0 ? Vector3d::Zero() : tree.station_velocity(body, p_W);
}

/// [forward, left, normal] in the axes of the link that they belong to.
Eigen::Matrix3d axes_of(const Vector3d& normal) {
  constexpr double kAcross = 1e-3;  // a y axis across the surface has no direction along it
  const auto along = [&](const Vector3d& axis) { return Vector3d(axis - axis.dot(normal) * normal); };
  Vector3d left = along(Vector3d::UnitY());
  if (left.norm() < kAcross) {
    left = along(Vector3d::UnitZ());
  }
  Eigen::Matrix3d axes;
  axes.col(1) = left.normalized();
  axes.col(2) = normal;
  axes.col(0) = axes.col(1).cross(normal);
  return axes;
}

}  // namespace

LinkContacts::LinkContacts(const Model& model, const std::vector<effects::Values>& values, int& next_state)
    : first_state_(next_state) {
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    take_contact(model, static_cast<int>(c), values, next_state);
  }
  states_ = next_state - first_state_;
}

void LinkContacts::take_contact(const Model& model, int contact, const std::vector<effects::Values>& values,
                                int& next_state) {
  const LinkContact& it = model.contacts[static_cast<std::size_t>(contact)];
  const int end = contact::parts_that_meet(it.ends[0].shape, it.ends[1].shape).empty() ? 1 : 0;
  const ContactEnd& one = it.ends[static_cast<std::size_t>(end)];
  const ContactEnd& other = it.ends[static_cast<std::size_t>(1 - end)];
  for (const contact::Round& part : contact::parts_that_meet(one.shape, other.shape)) {
    Slot slot;
    slot.contact = contact;
    slot.end = end;
    slot.first.link = one.body;
    slot.second.link = other.body;
    slot.part = part;
    slot.shape = other.shape;
    int next = next_state;
    slot.take(
        model, values, [&](const std::string& at) { return at == it.name; }, next);
    if (!slot.normals.empty()) {  // friction alone has nothing that presses
      next_state = next;
      slots_.push_back(std::move(slot));
    }
  }
}

bool LinkContacts::answers_to(int effect) const {
  const auto is_it = [&](const auto& use) { return use.effect == effect; };
  const auto has = [&](const auto& uses) { return std::any_of(uses.begin(), uses.end(), is_it); };
  return std::any_of(slots_.begin(), slots_.end(), [&](const Slot& slot) {
    return has(slot.normals) || has(slot.drags) || has(slot.changes);
  });
}

std::string LinkContacts::number_of(int point) const {
  const int contact = slots_[static_cast<std::size_t>(point)].contact;
  const auto first =
      std::find_if(slots_.begin(), slots_.end(), [&](const Slot& slot) { return slot.contact == contact; });
  const auto count =
      std::count_if(slots_.begin(), slots_.end(), [&](const Slot& slot) { return slot.contact == contact; });
  return count == 1 ? "" : " (" + std::to_string(point + 1 - (first - slots_.begin())) + ")";
}

void LinkContacts::find_links(const Model& model, const Mechanism& mechanism) {
  const std::vector<Isometry3d> poses = body_poses(model.skeleton, Eigen::VectorXd::Zero(mechanism.size()));
  const auto find = [&](Side& side) {
    if (side.link >= 0) {
      side.body = mechanism.tree_body(side.link);
      side.X_W = poses[static_cast<std::size_t>(side.link)];
    }
  };
  for (Slot& slot : slots_) {
    find(slot.first);
    find(slot.second);
  }
}

void LinkContacts::change(const std::vector<effects::Values>& stated, std::vector<effects::Values>& changed,
                          ContactLaws::Applied& applied) {
  for (Slot& slot : slots_) {
    slot.change(stated, changed, applied);
  }
}

LinkContacts LinkContacts::only(int point, bool with_drags) const {
  LinkContacts one = *this;
  one.slots_.assign(1, slots_[static_cast<std::size_t>(point)]);
  if (!with_drags) {
    one.slots_[0].drags.clear();
  }
  return one;
}

Isometry3d LinkContacts::pose_of(const Side& side, const TreeDynamics& tree) {
  if (side.body < 0) {
    return side.X_W;
  }
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = tree.rotation(side.body);
  pose.translation() = tree.station(side.body, Vector3d::Zero());
  return pose;
}

LinkTouch LinkContacts::meet(const Slot& slot, const Isometry3d& first, const Isometry3d& second) {
  const Isometry3d between = second.inverse(Eigen::Isometry) * first;
  const contact::Meeting met = contact::meet(contact::moved(between, slot.part), slot.shape);
  LinkTouch touch;
  touch.contact = slot.contact;
  touch.first = slot.end;
  touch.position = second * met.point;
  touch.axes = second.linear() * axes_of(met.normal);
  touch.depth = met.depth + slot.height;
  return touch;
}

LinkTouch LinkContacts::touch(int point, const TreeDynamics& tree) const {
  const Slot& slot = slots_[static_cast<std::size_t>(point)];
  LinkTouch touch = meet(slot, pose_of(slot.first, tree), pose_of(slot.second, tree));
  touch.velocity = velocity_of(slot.first.body, touch.position, tree) -
                   velocity_of(slot.second.body, touch.position, tree);
  return touch;
}

void LinkContacts::press(int point, const double* x, const std::vector<effects::Values>& values,
                         LinkTouch& touch, double* xdot) const {
  const Vector3d along = touch.axes.transpose() * touch.velocity;
  touch.force = touch.axes * slots_[static_cast<std::size_t>(point)].force(touch.depth, -along.z(),
                                                                           along.head<2>(), x, values, xdot);
}

void LinkContacts::add_forces(const TreeDynamics& tree, const double* x,
                              const std::vector<effects::Values>& values, Eigen::VectorXd& Q,
                              double* xdot) const {
  for (int point = 0; point < points(); ++point) {
    LinkTouch at = touch(point, tree);
    press(point, x, values, at, xdot);
    if (at.force.isZero(0.0)) {
      continue;
    }
    const Slot& slot = slots_[static_cast<std::size_t>(point)];
    if (slot.first.body >= 0) {
      tree.add_force(slot.first.body, at.position, at.force, Q);
    }
    if (slot.second.body >= 0) {
      tree.add_force(slot.second.body, at.position, -at.force, Q);
    }
  }
}

}  // namespace plumbline::model
