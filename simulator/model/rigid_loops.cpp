// The closed loops of rigid bodies: forces that hold them, and projection onto them.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "simulator/model/rigid_bodies.h"
#include "simulator/trace/error.h"

namespace plumbline::model {
namespace {

using Vector = Eigen::Map<const Eigen::VectorXd>;

constexpr double kDeadCentre = 1e-13;  // reciprocal condition of J M^-1 J'

}  // namespace

void RigidBodies::make_loops() {
  if (model_.loops.empty()) {
    return;
  }
  if (planar_base_is_bent()) {
    const Loop& loop = model_.loops.front();
    throw InputError({loop.file, loop.line, "loops: " + loop.name}, "a loop on a base that `boom` bends",
                     "either loops, or an effect at the base");
  }
  rigid_known_ = false;
  closure_ = own_closure();
  std::vector<Loop> holding;
  std::copy_if(model_.loops.begin(), model_.loops.end(), std::back_inserter(holding),
               [&](const Loop& loop) { return !map_.is_released(loop.name); });
  if (holding.size() == model_.loops.size()) {
    held_ = closure_;
  } else if (!holding.empty()) {
    held_ = std::make_shared<LoopClosure>(model_, holding, map_.S_tree(), map_.q0().head(n_tree_));
  }
  if (held_ != nullptr && held_->size() >= nz_) {
    throw InputError({holding.back().file, holding.back().line, "loops: " + holding.back().name},
                     "loops that leave no joint free to move", "at least one that can");
  }
}

// The ways of a base that an effect bends are the structure's, not the skeleton's.
bool RigidBodies::planar_base_is_bent() const {
  return std::any_of(structures_.begin(), structures_.end(),
                     [&](const StructureSlot& slot) { return sits_at_base(slot.effect); });
}

std::unique_ptr<LoopClosure> RigidBodies::own_closure() const {
  return model_.loops.empty()
             ? nullptr
             : std::make_unique<LoopClosure>(model_, model_.loops, map_.S_tree(), map_.q0().head(n_tree_));
}

Eigen::VectorXd RigidBodies::home() const {
  return closure_ != nullptr ? closure_->home() : Eigen::VectorXd(Eigen::VectorXd::Zero(nz_));
}

// At the position and velocity that M_ and h_ were evaluated at.
void RigidBodies::hold_loops() {
  LoopRows& rows = held_->rows();
  const TreeDynamics& tree = this->tree();
  rows.jacobian(tree, n_tree_, loop_tree_J_);
  rows.bias(tree, loop_bias_);
  loop_J_.noalias() = loop_tree_J_ * map_.S_tree();
  loop_Y_ = factor_.solve(loop_J_.transpose());
  loop_factor_.compute(loop_J_ * loop_Y_);
  if (loop_J_.allFinite() && M_.allFinite() &&
      (loop_factor_.info() != Eigen::Success || !(loop_factor_.rcond() > kDeadCentre))) {
    throw std::runtime_error(model_.file + ": loop " + model_.loops.front().name +
                             (model_.loops.size() > 1 ? " or another" : "") +
                             ": found links at a dead centre, where a loop branches; expected a motion that "
                             "stays away from it");
  }
}

// M a = Q + J' lambda with J a + bias = 0.
void RigidBodies::accelerate(const Eigen::VectorXd& Q, Eigen::VectorXd& acceleration) const {
  acceleration = factor_.solve(Q);
  if (has_loops()) {
    acceleration -= loop_Y_ * loop_factor_.solve(loop_J_ * acceleration + loop_bias_);
  }
}

// What a further force adds to the acceleration.
Eigen::VectorXd RigidBodies::accelerated(const Eigen::VectorXd& Q) const {
  Eigen::VectorXd acceleration = factor_.solve(Q);
  if (has_loops()) {
    acceleration -= loop_Y_ * loop_factor_.solve(loop_J_ * acceleration);
  }
  return acceleration;
}

void RigidBodies::accelerate_in_place(Eigen::MatrixXd& Q) const {
  factor_.solveInPlace(Q);
  if (has_loops()) {
    Q -= loop_Y_ * loop_factor_.solve(loop_J_ * Q);
  }
}

Eigen::VectorXd RigidBodies::beside_loops(const Eigen::VectorXd& Q, const Eigen::VectorXd& z,
                                          Eigen::VectorXd& lambda) {
  const Eigen::MatrixXd J = held_->jacobian(z);
  lambda = -(J * J.transpose()).ldlt().solve(J * Q);
  return Q + J.transpose() * lambda;
}

Eigen::VectorXd RigidBodies::with_loops(const Eigen::VectorXd& Q, const Eigen::VectorXd& z,
                                        const Eigen::VectorXd& lambda) {
  return Q + held_->jacobian(z).transpose() * lambda;
}

Eigen::VectorXd RigidBodies::move_along_loops(const Eigen::MatrixXd& K, const Eigen::VectorXd& force,
                                              const Eigen::VectorXd& z) {
  const Eigen::VectorXd off = held_->errors(z);
  const Eigen::MatrixXd J = held_->jacobian(z);
  const Eigen::Index loops = off.size();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(nz_ + loops, nz_ + loops);
  all.topLeftCorner(nz_, nz_) = K;
  all.topRightCorner(nz_, loops) = J.transpose();
  all.bottomLeftCorner(loops, nz_) = J;
  Eigen::VectorXd right(all.rows());
  right << force, off;
  return -all.fullPivLu().solve(right).head(nz_);
}

// By differences of the acceleration itself: M, h, J and the bias all move.
void RigidBodies::loop_slope(const double* x, const Eigen::VectorXd& Q, const Eigen::VectorXd& a0,
                             Eigen::MatrixXd& slope) {
  constexpr double kPositionStep = 1e-6;  // rad or m
  constexpr double kVelocityStep = 1e-4;
  LoopRows& rows = held_->rows();
  Eigen::VectorXd moved = Vector(x, 2 * nz_);
  Eigen::MatrixXd M, J;
  Eigen::VectorXd h, bias;
  for (int i = 0; i < 2 * nz_; ++i) {
    const double step = i < nz_ ? kPositionStep : kVelocityStep;
    moved[i] = x[i] + step;
    evaluate(moved.data(), structure_, M, h);
    rows.jacobian(tree(), n_tree_, loop_tree_J_);
    rows.bias(tree(), bias);
    J.noalias() = loop_tree_J_ * map_.S_tree();
    const Eigen::LLT<Eigen::MatrixXd> mass(M);
    const Eigen::MatrixXd Y = mass.solve(J.transpose());
    Eigen::VectorXd a = mass.solve(Q - h);
    a -= Y * (J * Y).llt().solve(J * a + bias);
    slope.col(i) = (a - a0) / step;
    moved[i] = x[i];
  }
}

// Newton's method with the directions M^-1 J' of where it begins: no motion of the free joints is invented.
double RigidBodies::close_loops(double* x) {
  constexpr int kRounds = 12;
  factor_at(x);
  const Eigen::MatrixXd Y = loop_Y_;
  Eigen::Map<Eigen::VectorXd> z(x, nz_);
  Eigen::Map<Eigen::VectorXd> w(x + nz_, nz_);
  Eigen::VectorXd off = held_->errors(z);
  const double before = off.cwiseAbs().maxCoeff();
  double size = before;
  for (int round = 0; round < kRounds && size > 0.0; ++round) {
    const Eigen::VectorXd there = z - Y * (held_->jacobian(z) * Y).partialPivLu().solve(off);
    const Eigen::VectorXd left = held_->errors(there);
    const double smaller = left.cwiseAbs().maxCoeff();
    if (!(smaller < size)) {
      break;
    }
    z = there;
    off = left;
    size = smaller;
  }
  if (!held_->is_closed(z)) {
    throw std::runtime_error(model_.file + ": loop " + model_.loops.front().name +
                             ": found a state whose loops cannot be closed near it");
  }
  const Eigen::MatrixXd& J = held_->jacobian(z);
  const Eigen::PartialPivLU<Eigen::MatrixXd> onto(J * Y);
  for (int round = 0; round < 2; ++round) {  // the second takes off the rounding of the first
    w -= Y * onto.solve(J * w);
  }
  return before;
}

Eigen::Vector2d RigidBodies::loop_errors(const double* x) {
  const Vector z(x, nz_);
  const Vector w(x + nz_, nz_);
  return {held_->errors(z).cwiseAbs().maxCoeff(), (held_->jacobian(z) * w).cwiseAbs().maxCoeff()};
}

// z moves by P dz, P = 1 - Y (J Y)^-1 J; w by P dw less what the turn of J asks for.
Eigen::MatrixXd RigidBodies::closing_slope(const double* x) {
  constexpr double kStep = 1e-6;  // rad or m
  factor_at(x);
  const Vector z(x, nz_);
  const Vector w(x + nz_, nz_);
  const Eigen::MatrixXd back =
      loop_Y_ * loop_factor_.solve(Eigen::MatrixXd::Identity(loop_J_.rows(), loop_J_.rows()));
  const Eigen::MatrixXd P = Eigen::MatrixXd::Identity(nz_, nz_) - back * loop_J_;
  Eigen::MatrixXd turn(loop_J_.rows(), nz_);
  Eigen::VectorXd moved = z;
  for (int i = 0; i < nz_; ++i) {
    moved[i] = z[i] + kStep;
    turn.col(i) = held_->jacobian(moved) * w;
    moved[i] = z[i] - kStep;
    turn.col(i) -= held_->jacobian(moved) * w;
    moved[i] = z[i];
  }
  turn /= 2.0 * kStep;
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(2 * nz_, 2 * nz_);
  slope.topLeftCorner(nz_, nz_) = P;
  slope.bottomRightCorner(nz_, nz_) = P;
  slope.bottomLeftCorner(nz_, nz_) = -back * turn * P;
  return slope;
}

}  // namespace plumbline::model
