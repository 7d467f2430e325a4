#include "simulator/rigid/constraints.h"

#include <Eigen/QR>
#include <limits>
#include <stdexcept>

namespace plumbline::rigid {

void Constraints::set(const Eigen::MatrixXd& M, const Eigen::MatrixXd& J) {
  if (M.rows() != M.cols() || J.cols() != M.cols()) {
    throw std::invalid_argument("constraints: found J with " + std::to_string(J.cols()) +
                                " columns, expected as many as M has (" + std::to_string(M.cols()) + ")");
  }
  factor_.compute(M);
  if (factor_.info() != Eigen::Success) {
    throw std::invalid_argument("constraints: found a mass matrix that is not positive definite");
  }
  J_ = J;
  X_ = factor_.matrixL().solve(J.transpose());
  rank_ = 0;
  pseudo_inverse_.setZero(J.rows(), M.cols());
  if (J.rows() > 0) {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(1e-10);  // rows are of the size of lengths or 1
    decomposition.compute(X_);
    pseudo_inverse_ = decomposition.pseudoInverse();
    rank_ = static_cast<int>(decomposition.rank());
  }
}

// y = L' dv/dt: y = y0 + X lambda with X' y = -bias.
Constraints::Motion Constraints::hold(const Eigen::VectorXd& Q, const Eigen::VectorXd& bias) const {
  const Eigen::VectorXd free = factor_.matrixL().solve(Q);
  Motion motion;
  motion.reaction = -pseudo_inverse_ * (pseudo_inverse_.transpose() * bias + free);
  motion.acceleration = factor_.matrixU().solve(free + X_ * motion.reaction);
  return motion;
}

Constraints::Impact Constraints::strike(const Eigen::VectorXd& v) const {
  const Eigen::VectorXd before = factor_.matrixU() * v;
  Impact impact;
  impact.impulse = -pseudo_inverse_ * before;
  const Eigen::VectorXd blow = X_ * impact.impulse;
  impact.velocity = v + factor_.matrixU().solve(blow);
  impact.lost = 0.5 * blow.squaredNorm();  // Carnot: that of the velocity that was lost
  return impact;
}

Eigen::VectorXd Constraints::correction(const Eigen::VectorXd& error) const {
  return factor_.matrixU().solve(-pseudo_inverse_.transpose() * error);
}

double FootLoad::needed_friction() const {
  return normal > 0.0 ? friction / normal : std::numeric_limits<double>::infinity();
}

FootLoad foot_load(const Eigen::Vector3d& force, const Eigen::Vector3d& normal) {
  const double along = force.dot(normal);
  return {along, (force - along * normal).norm()};
}

}  // namespace plumbline::rigid
