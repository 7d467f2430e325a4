// Constrained nonlinear least squares, solved by IPOPT (Waechter, Biegler, Mathematical Programming 106,
// 2006) with the Gauss-Newton matrix as Hessian: the constraints' curvature is left out, so that it converges
// quickly where the residuals are small at the solution, and not at all where they are large and the
// constraints bend.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>

namespace plumbline::validation {

/// minimise |r(x)|^2 / 2 subject to lower <= x <= upper, c(x) = 0, d(x) >= 0.
struct LeastSquares {
  struct Values {
    Eigen::VectorXd residuals;     ///< r
    Eigen::VectorXd equalities;    ///< c
    Eigen::VectorXd inequalities;  ///< d
  };
  /// False: x has no value (the robot fell); the solver then takes a shorter step.
  std::function<bool(const Eigen::VectorXd& x, Values& values)> evaluate;
  Eigen::VectorXd start, lower, upper;
  Eigen::VectorXd scale;  ///< by which each unknown is divided; also sets the steps of the differences
  int residuals = 0, equalities = 0, inequalities = 0;
  double difference = 1e-6;  ///< step of the central differences, in units of scale
  double tolerance = 1e-8;
  double feasible = 1e-4;  ///< constraints that are met to this count as met
  double damping = 0.0;    ///< added to the Hessian's diagonal (Levenberg), in units of scale
  int iterations = 200;
  int print_level = 0;  ///< IPOPT's own
};

struct LeastSquaresResult {
  Eigen::VectorXd x;  ///< where the solver ended; where that is no solution, the best feasible point it met
  LeastSquares::Values values;
  bool feasible = false;  ///< constraints are met at x
  bool solved = false;    ///< and it is a minimum
  std::string status;     ///< IPOPT's, in words
  int iterations = 0;
};

/// Throws std::runtime_error where the start has no value.
LeastSquaresResult solve(const LeastSquares& problem);

}  // namespace plumbline::validation
