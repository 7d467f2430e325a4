// Links of a Plant that meet each other: LinkContacts on the independent coordinates.
#include <memory>
#include <utility>

#include "simulator/model/plant.h"

namespace plumbline::model {

void Plant::place_links(int& next_state) {
  if (model_.contacts.empty()) {
    return;
  }
  auto links = std::make_unique<LinkContacts>(model_, values_, next_state);
  if (!links->empty()) {
    links_ = std::move(links);
  }
}

void Plant::add_links(const double* x, Eigen::VectorXd& Q, double* xdot) {
  ground_.setZero(n_tree_);
  links_->add_forces(tree(), x, on_ground_, ground_, xdot);
  for (int j = 0; j < n_tree_; ++j) {
    for (const Entry& entry : S_rows_[static_cast<std::size_t>(j)]) {
      Q[entry.index] += entry.value * ground_[j];
    }
  }
}

// Adds the slopes of the forces to slopes_, those of bristles' rates to A.
// A writable view is passed by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void Plant::link_tangent(const double* x, const double* change, Eigen::Ref<Eigen::MatrixXd> A) {
  Eigen::VectorXd dq = Eigen::VectorXd::Zero(n_tree_);
  Eigen::VectorXd dv = dq;
  if (change != nullptr) {
    dq = S_tree_ * Eigen::Map<const Eigen::VectorXd>(change, nz_);
    dv = S_tree_ * Eigen::Map<const Eigen::VectorXd>(change + nz_, nz_);
  }
  LinkSlopes by;
  links_->find_slopes(tree(), x, nx_, on_ground_, dq, dv, by);
  const int first = links_->first_state();
  const int count = links_->states();
  slopes_.leftCols(nz_) += S_tree_.transpose() * by.force_by_q * S_tree_;
  slopes_.middleCols(nz_, nz_) += S_tree_.transpose() * by.force_by_v * S_tree_;
  slopes_.middleCols(first, count) += S_tree_.transpose() * by.force_by_s;
  A.block(first, 0, count, nz_) += by.rate_by_q * S_tree_;
  A.block(first, nz_, count, nz_) += by.rate_by_v * S_tree_;
  A.block(first, first, count, count) += by.rate_by_s;
}

// The links are where rate() has left them. Adds to the column.
void Plant::link_parameter_tangent(const double* x, ParameterId id, double step, effects::Values moved,
                                   Eigen::Ref<Eigen::VectorXd> column) {
  effects::Values& stored = values_[static_cast<std::size_t>(id.effect)];
  Eigen::VectorXd now = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd up = now;
  Eigen::VectorXd before = Eigen::VectorXd::Zero(nz_);
  Eigen::VectorXd after = before;
  add_links(x, before, now.data());
  std::swap(stored, moved);
  change_ground();
  add_links(x, after, up.data());
  std::swap(stored, moved);
  change_ground();
  column += (up - now) / step;
  column.segment(nz_, nz_) += accelerated((after - before) / step);
}

// As for feet, what bristles take is booked as it goes.
void Plant::link_energetics(const double* x, Energetics& e) const {
  for (int point = 0; point < link_points(); ++point) {
    LinkTouch at = links_->touch(point, tree());
    links_->press(point, x, on_ground_, at, nullptr);
    for (const ContactLaws::Normal& use : links_->laws(point).normals) {
      e.stored += use.law->stored_energy(at.depth, on_ground(use.effect));
      e.dissipated += use.law->dissipated_power(at.depth, at.rate(), on_ground(use.effect));
    }
    const Eigen::Vector3d drag = at.force - at.normal().dot(at.force) * at.normal();
    e.dissipated -= drag.dot(at.velocity);
  }
}

std::vector<LinkTouch> Plant::link_touches(const double* x) {
  std::vector<LinkTouch> all;
  if (links_ != nullptr) {
    rigid_at(x);
  }
  for (int point = 0; point < link_points(); ++point) {
    all.push_back(links_->touch(point, tree()));
    links_->press(point, x, on_ground_, all.back(), nullptr);
  }
  return all;
}

std::vector<Eigen::Vector3d> Plant::contact_forces(const double* x) {
  std::vector<Eigen::Vector3d> forces(model_.contacts.size(), Eigen::Vector3d::Zero());
  for (const LinkTouch& at : link_touches(x)) {
    forces[static_cast<std::size_t>(at.contact)] += at.first == 0 ? at.force : Eigen::Vector3d(-at.force);
  }
  return forces;
}

}  // namespace plumbline::model
