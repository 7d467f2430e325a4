#include "simulator/model/rigid_bodies.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "simulator/model/body_change.h"
#include "simulator/model/joint_chain.h"
#include "simulator/model/planar_base.h"
#include "simulator/trace/error.h"

namespace plumbline::model {

using effects::Place;
using Vector = Eigen::Map<const Eigen::VectorXd>;

RigidBodies::RigidBodies(const Model& model, const std::vector<effects::Values>& values,
                         const CoordinateMap& map)
    : model_(model), values_(values), map_(map), n_tree_(map.tree()), nz_(map.independent()) {
  int coordinate = 0;
  const std::vector<int>& charts = model_.skeleton.charts;
  for (std::size_t j = 0; j < model_.skeleton.joints.size(); ++j) {
    if (std::find(charts.begin(), charts.end(), static_cast<int>(j)) != charts.end()) {
      charts_.push_back(coordinate);
    }
    coordinate += model_.skeleton.joints[j].type == JointType::fixed ? 0 : 1;
  }
  for (std::size_t e = 0; e < model_.effects.size(); ++e) {
    if (const auto* structure = dynamic_cast<const effects::StructureLaw*>(model_.effects[e].law.get())) {
      structures_.push_back({structure, static_cast<int>(e)});
    }
  }
  structure_ = make_structure();
}

void RigidBodies::rebuild() {
  structure_ = make_structure();
  rigid_known_ = false;
}

bool RigidBodies::depend_on(int effect) const {
  return std::any_of(structures_.begin(), structures_.end(),
                     [&](const StructureSlot& slot) { return slot.effect == effect; });
}

void RigidBodies::swap(BodyStructure& other) {
  std::swap(structure_, other);
  rigid_known_ = false;
}

bool RigidBodies::sits_at_base(int effect) const {
  return model_.effects[static_cast<std::size_t>(effect)].law->sits_at(Place::base);
}

void RigidBodies::apply_change(const StructureSlot& slot, Skeleton& skeleton,
                               Eigen::VectorXd& inertia) const {
  const EffectUse& use = model_.effects[static_cast<std::size_t>(slot.effect)];
  const effects::StructureChange change =
      slot.law->change(values_[static_cast<std::size_t>(slot.effect)].data());
  switch (model_.resolve(*slot.law, use.at)) {
    case Place::body: {
      Body& body = skeleton.bodies[static_cast<std::size_t>(model_.body_index(use.at))];
      change_body(body, change, model_.file + ": " + use.label());
      return;
    }
    case Place::world:
      if (change.tilt.norm() > 0.0) {
        skeleton.gravity = Eigen::AngleAxisd(change.tilt.norm(), change.tilt.normalized()) * skeleton.gravity;
      }
      return;
    case Place::base:
      bend_base(skeleton, *planar_base(skeleton), change.curvature, change.level);
      return;
    default:
      for (std::size_t m = 0; m < model_.motors.size(); ++m) {
        if (model_.motors[m].name == use.at) {
          inertia[n_tree_ + static_cast<int>(m)] += change.inertia;
        }
      }
  }
}

BodyStructure RigidBodies::make_structure() const {
  BodyStructure structure;
  Skeleton skeleton = model_.skeleton;
  const int motors = static_cast<int>(model_.motors.size());
  structure.extra_inertia = Eigen::VectorXd::Zero(map_.full());
  for (int m = 0; m < motors; ++m) {
    structure.extra_inertia[n_tree_ + m] = model_.motors[static_cast<std::size_t>(m)].rotor_inertia.value;
  }
  for (std::size_t p = 0; p < model_.pulleys.size(); ++p) {
    structure.extra_inertia[n_tree_ + motors + static_cast<int>(p)] = model_.pulleys[p].inertia.value;
  }
  for (const StructureSlot& slot : structures_) {
    apply_change(slot, skeleton, structure.extra_inertia);
  }
  structure.extra_reduced = map_.S().transpose() * structure.extra_inertia.asDiagonal() * map_.S();
  for (const Inertia& inertia : model_.inertias) {
    const Eigen::VectorXd a = map_.S().transpose() * map_.full_direction(inertia.at);
    structure.extra_reduced += inertia.value.value * a * a.transpose();
  }
  structure.mechanism = std::make_unique<Mechanism>(skeleton);
  return structure;
}

void RigidBodies::check_mass_matrix() {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * nz_);
  factor_at(x.data());
  const bool positive = factor_.info() == Eigen::Success && M_.allFinite() && M_.diagonal().minCoeff() > 0.0;
  if (!positive || factor_.rcond() < 1e-13) {
    throw InputError(
        model_.file + ": found a singular mass matrix (" + std::to_string(nz_) +
        " independent coordinates), expected every coordinate to move some inertia; check masses, "
        "rotor inertias and ratios");
  }
}

// S has few entries that are not zero: S' M S by columns of M.
void RigidBodies::evaluate(const double* x, BodyStructure& structure, Eigen::MatrixXd& M,
                           Eigen::VectorXd& h) {
  rigid_known_ = false;
  q_ = map_.q0().head(n_tree_);
  v_.setZero(n_tree_);
  for (int j = 0; j < n_tree_; ++j) {
    for (const LinearForm::Entry& entry : map_.row(j)) {
      q_[j] += entry.value * x[entry.index];
      v_[j] += entry.value * x[nz_ + entry.index];
    }
  }
  structure.mechanism->evaluate(q_, v_, M_tree_, h_tree_);
  SM_.setZero(nz_, n_tree_);
  M = structure.extra_reduced;
  h.setZero(nz_);
  for (int j = 0; j < n_tree_; ++j) {
    for (int i = 0; i < n_tree_; ++i) {
      for (const LinearForm::Entry& entry : map_.row(i)) {
        SM_(entry.index, j) += entry.value * M_tree_(i, j);
      }
    }
    for (const LinearForm::Entry& entry : map_.row(j)) {
      M.col(entry.index) += entry.value * SM_.col(j);
      h[entry.index] += entry.value * h_tree_[j];
    }
  }
}

// Jacobians, switches and the first stage of a step ask for the same positions and velocities one after the
// other.
void RigidBodies::rigid_at(const double* x) {
  if (rigid_known_ && std::equal(x, x + 2 * nz_, known_.data())) {
    return;
  }
  evaluate(x, structure_, M_, h_);
  known_ = Vector(x, 2 * nz_);
  rigid_known_ = true;
  factored_ = false;
}

void RigidBodies::factor_at(const double* x) {
  rigid_at(x);
  if (!factored_) {
    factor_.compute(M_);
    factored_ = true;
    if (has_loops()) {
      hold_loops();
    }
  }
}

// Joint positions are those of the last evaluation.
void RigidBodies::check_charts() const {
  for (const int pitch : charts_) {
    if (std::abs(std::cos(q_[pitch])) < kLostCosineOfPitch) {
      throw std::runtime_error(model_.file + ": " +
                               chart_refusal(map_.name_of(pitch), q_[pitch], kLostCosineOfPitch));
    }
  }
}

double RigidBodies::energy(const double* x) const {
  const Vector w(x + nz_, nz_);
  return structure_.mechanism->energy(q_, v_) + 0.5 * w.dot(structure_.extra_reduced * w);
}

}  // namespace plumbline::model
