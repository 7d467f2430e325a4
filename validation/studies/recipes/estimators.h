// The paper's closed-form estimators, numbers in, numbers out. Equations are those of Park et al.,
// "Identification of a Bipedal Robot with a Compliant Drivetrain".
#pragma once

#include <Eigen/Core>

namespace plumbline::validation {

/// Values with their covariance, and the degrees of freedom behind it.
struct Regression {
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;
  int degrees_of_freedom = 0;
};

/// Least squares y = X b; covariance from the residuals: s^2 (X'X)^-1, s^2 = |y - X b|^2 / (rows - columns).
/// Throws std::invalid_argument when there are no more rows than columns.
Regression least_squares(const Eigen::MatrixXd& X, const Eigen::VectorXd& y);

/// Equations S1, S2 on J w' + mu w = u + bias, by least squares on
///   y_k = a y_(k-1) + b1 u_(k-1) + b2.
/// For commands held over the sample T, a = exp(-mu T/J) and b1 = (1 - a)/mu; hence bias = b2/b1, mu = (1 -
/// a)/b1, J = -mu T / ln a. Values: bias, J, mu, in units of the command. `velocity` and `command` are of the
/// same samples; u_k is held from sample k to k + 1. Covariance by the delta method.
Regression first_order_arx(const Eigen::VectorXd& velocity, const Eigen::VectorXd& command, double period);

/// Equation 14: J_exp,i = alpha_torque (alpha_rotor rotor + pulleys_i). Values: alpha_torque, alpha_rotor.
/// Least squares weighted by the lumped inertias' deviations, from which the covariance follows.
Regression equation_14(double rotor, const Eigen::VectorXd& pulleys, const Eigen::VectorXd& lumped,
                       const Eigen::VectorXd& deviations);

/// Equation 22 for many postures, with a preload as Figure 17 has it:
///   weight sin(shape) / ratio = K_B q_Bsp + preload.
/// Values: K_B (N m/rad), preload (N m).
Regression equation_22(const Eigen::VectorXd& shape, const Eigen::VectorXd& spring,
                       const Eigen::VectorXd& weight, double ratio);

/// Every `every`-th value, and the mean of each group of `every`.
Eigen::VectorXd every_nth(const Eigen::VectorXd& values, Eigen::Index every);
Eigen::VectorXd group_means(const Eigen::VectorXd& values, Eigen::Index every);

}  // namespace plumbline::validation
