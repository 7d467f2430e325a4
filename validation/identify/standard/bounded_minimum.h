// The minimum of a quadratic function within bounds, by an active set.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plumbline::validation {

struct BoundedMinimum {
  Eigen::VectorXd at;
  std::vector<bool> held;  ///< at a bound, and pressed against it
};

/// Minimises d' H d - 2 g' d over lower <= d <= upper, H positive definite, from d = 0, which must lie
/// within. Exact however unlike the curvatures are, where coordinate descent (box_least_squares.h) creeps.
/// Source: J. Nocedal, S. J. Wright, Numerical Optimization, 2006, algorithm 16.3 (active set, convex).
BoundedMinimum bounded_minimum(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                               const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

/// Rows and columns of H that `held` leaves, and the entries of g.
Eigen::MatrixXd free_part(const Eigen::MatrixXd& H, const std::vector<bool>& held);
Eigen::VectorXd free_part(const Eigen::VectorXd& g, const std::vector<bool>& held);

}  // namespace plumbline::validation
