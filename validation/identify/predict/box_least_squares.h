// Least squares within bounds on stored normal equations.
#pragma once

#include <Eigen/Core>

namespace plumbline::validation {

/// Weak prior on every unknown, one standard deviation of ten units: unknowns that the data do not see stay
/// where they are, all others hardly feel it (the cost is counted in sensor floors).
constexpr double kPriorPrecision = 1e-2;

/// Minimises d'(H + kPriorPrecision) d - 2 g'd over lower <= d <= upper by cyclic coordinate descent (H
/// positive semidefinite, a few dozen unknowns). Directions with no curvature stay at zero.
Eigen::VectorXd box_least_squares(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                                  const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace plumbline::validation
