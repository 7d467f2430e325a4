#include "validation/identify/predict/box_least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace plumbline::validation {

Eigen::VectorXd box_least_squares(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                                  const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::Index n = g.size();
  // The unconstrained minimum is usually inside.
  Eigen::MatrixXd A = H;
  A.diagonal().array() += kPriorPrecision;
  const Eigen::LDLT<Eigen::MatrixXd> factor(A);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(n);
  if (n > 0 && factor.info() == Eigen::Success && factor.isPositive()) {
    d = factor.solve(g);
    if ((d.array() >= lower.array()).all() && (d.array() <= upper.array()).all()) {
      return d;
    }
  }
  d = d.cwiseMax(lower).cwiseMin(upper);
  Eigen::VectorXd slope = g - A * d;
  for (int sweep = 0; sweep < 2000; ++sweep) {
    double moved = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!(A(i, i) > 0.0)) {
        continue;
      }
      const double next = std::clamp(d[i] + slope[i] / A(i, i), lower[i], upper[i]);
      const double step = next - d[i];
      if (step != 0.0) {
        slope -= A.col(i) * step;
        d[i] = next;
        moved = std::max(moved, std::abs(step) * std::sqrt(A(i, i)));
      }
    }
    if (moved < 1e-6) {
      break;
    }
  }
  return d;
}

}  // namespace plumbline::validation
