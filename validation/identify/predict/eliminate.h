// Least squares with some of the unknowns eliminated.
#pragma once

#include <Eigen/Core>

namespace plumbline::validation {

/// min over x of |r - X x - J p|^2 = sse - 2 g'p + p'H p, at x = step - slope p.
struct Eliminated {
  double sse = 0.0;
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  Eigen::VectorXd step;
  Eigen::MatrixXd slope;  ///< x by p
  Eigen::VectorXd r;      ///< what is left of r at p = 0
  Eigen::MatrixXd J;      ///< and of J
  Eigen::MatrixXd R;      ///< upper triangle with X'X = R'R
};

/// X (rows x n, of full rank) by Householder's QR; J may have no columns. Where columns of J are 1e11 times
/// as long as what X leaves of them, that is still right to five digits.
Eliminated eliminate(const Eigen::MatrixXd& X, const Eigen::MatrixXd& J, const Eigen::VectorXd& r);

}  // namespace plumbline::validation
