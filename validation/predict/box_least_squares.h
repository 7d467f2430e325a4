// Least squares within bounds on stored normal equations.
#pragma once

#include <Eigen/Core>

namespace plumbline::validation {

/// Minimises d'H d - 2 g'd over lower <= d <= upper by cyclic coordinate descent (H positive semidefinite,
/// a few dozen unknowns). Directions with no curvature stay at zero.
Eigen::VectorXd box_least_squares(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                                  const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace plumbline::validation
