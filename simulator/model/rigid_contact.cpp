#include "simulator/model/rigid_contact.h"

#include <algorithm>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

Eigen::Index rows(const std::vector<int>& feet) { return 3 * static_cast<Eigen::Index>(feet.size()); }

}  // namespace

RigidContact::RigidContact(Plant& plant)
    : plant_(plant),
      kinematics_(plant),
      rate_(Eigen::VectorXd::Zero(plant.states())),
      no_command_(Eigen::VectorXd::Zero(plant.motors())) {
  if (plant.has_loops()) {
    throw InputError(
        plant.model().file + ": loop " + plant.model().loops.front().name +
        ": found a closed loop of a robot on rigid ground, expected a tree, or laws of the ground");
  }
  for (const Foot& foot : plant.model().feet) {
    if (foot.radius > 0.0) {
      throw InputError(plant.model().file + ": foot " + foot.name + ": found a radius of " +
                       number_text(foot.radius) + " m, expected a point: rigid ground holds points");
    }
  }
}

const Eigen::MatrixXd& RigidContact::mass_matrix(const double* x) {
  plant_.rate(x, no_command_.data(), rate_.data());
  return plant_.mass_matrix();
}

Eigen::MatrixXd RigidContact::rows_of(const Holds& holds, const double* x, Eigen::VectorXd* bias) {
  const Eigen::Index at_feet = rows(holds.feet);
  const Eigen::Index all = at_feet + static_cast<Eigen::Index>(holds.coordinates.size());
  Eigen::MatrixXd J(all, plant_.positions());
  if (bias != nullptr) {
    bias->setZero(all);
  }
  Eigen::Index row = 0;
  for (const int foot : holds.feet) {
    const PointMotion point = kinematics_.foot(foot, x);
    J.middleRows(row, 3) = point.jacobian;
    if (bias != nullptr) {
      bias->segment<3>(row) = point.bias;
    }
    row += 3;
  }
  const bool found = &holds == &holds_;  // looked up once
  for (std::size_t i = 0; i < holds.coordinates.size(); ++i) {
    J.row(row++) = found ? rows_[i] : kinematics_.row_of(holds.coordinates[i]);
  }
  return J;
}

void RigidContact::hold(const Holds& holds, const double* x) {
  where_.clear();
  rows_.clear();
  for (const std::string& name : holds.coordinates) {
    rows_.push_back(kinematics_.row_of(name));
  }
  for (const int foot : holds.feet) {
    where_.push_back(kinematics_.foot(foot, x).position);
  }
  at_.resize(static_cast<Eigen::Index>(holds.coordinates.size()));
  for (Eigen::Index i = 0; i < at_.size(); ++i) {
    at_[i] = plant_.position_of(holds.coordinates[static_cast<std::size_t>(i)], x);
  }
  holds_ = holds;
  reaction_.setZero(rows(holds.feet) + at_.size());
}

void RigidContact::rate(const double* x, const double* command, double* xdot) {
  const int n = plant_.positions();
  plant_.rate(x, command, xdot);  // as if nothing were held
  const Eigen::VectorXd Q = plant_.mass_matrix() * Eigen::Map<const Eigen::VectorXd>(xdot + n, n);
  const Eigen::MatrixXd J = rows_of(holds_, x, &bias_);
  constraints_.set(plant_.mass_matrix(), J);
  const rigid::Constraints::Motion motion = constraints_.hold(Q, bias_);
  reaction_ = motion.reaction;
  std::copy(motion.acceleration.data(), motion.acceleration.data() + n, xdot + n);
}

Eigen::Vector3d RigidContact::foot_force(int foot) const { return reaction_.segment<3>(3 * foot); }

double RigidContact::holding_force(int coordinate) const { return reaction_[rows(holds_.feet) + coordinate]; }

Eigen::VectorXd RigidContact::error(const double* x) {
  Eigen::VectorXd off(rows(holds_.feet) + at_.size());
  for (std::size_t f = 0; f < where_.size(); ++f) {
    off.segment<3>(3 * static_cast<Eigen::Index>(f)) =
        kinematics_.foot(holds_.feet[f], x).position - where_[f];
  }
  for (Eigen::Index i = 0; i < at_.size(); ++i) {
    off[rows(holds_.feet) + i] =
        plant_.position_of(holds_.coordinates[static_cast<std::size_t>(i)], x) - at_[i];
  }
  return off;
}

double RigidContact::project(double* x) {
  const int n = plant_.positions();
  double before = -1.0;
  for (int round = 0; round < 4; ++round) {  // Newton's method; the first step is all but exact
    const Eigen::VectorXd off = error(x);
    const double size = off.size() > 0 ? off.cwiseAbs().maxCoeff() : 0.0;
    before = before < 0.0 ? size : before;
    const Eigen::MatrixXd J = rows_of(holds_, x, nullptr);
    constraints_.set(mass_matrix(x), J);
    if (size < 1e-14) {
      break;
    }
    Eigen::Map<Eigen::VectorXd>(x, n) += constraints_.correction(off);
  }
  Eigen::Map<Eigen::VectorXd> w(x + n, n);
  w = constraints_.strike(w).velocity;
  return before;
}

RigidContact::Blow RigidContact::strike(const Holds& caught, double* x) {
  const int n = plant_.positions();
  const Eigen::MatrixXd J = rows_of(caught, x, nullptr);
  rigid::Constraints constraints;
  constraints.set(mass_matrix(x), J);
  Eigen::Map<Eigen::VectorXd> w(x + n, n);
  const rigid::Constraints::Impact impact = constraints.strike(w);
  w = impact.velocity;
  Blow blow;
  for (std::size_t f = 0; f < caught.feet.size(); ++f) {
    blow.feet.emplace_back(impact.impulse.segment<3>(3 * static_cast<Eigen::Index>(f)));
  }
  blow.coordinates = impact.impulse.tail(impact.impulse.size() - rows(caught.feet));
  blow.lost = impact.lost;
  return blow;
}

}  // namespace plumbline::model
