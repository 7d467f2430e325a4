// The paper's estimators against closed forms and published regressions.
#include "validation/studies/recipes/estimators.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::validation {
namespace {

// F. J. Anscombe, Graphs in statistical analysis, The American Statistician 27 (1973) 17-21: each of his data
// sets has the line y = 3 + 0.5 x with a standard error of 0.118 for the slope and 9 degrees of freedom.
TEST(LeastSquares, GivesAnscombesLineAndItsStandardError) {
  Eigen::VectorXd x(11);
  Eigen::VectorXd y(11);
  x << 10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5;
  y << 8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68;
  Eigen::MatrixXd X(11, 2);
  X << x, Eigen::VectorXd::Ones(11);
  const Regression line = least_squares(X, y);
  EXPECT_NEAR(line.values[0], 0.500, 5e-4);
  EXPECT_NEAR(line.values[1], 3.00, 5e-3);
  EXPECT_NEAR(std::sqrt(line.covariance(0, 0)), 0.118, 5e-4);
  EXPECT_EQ(line.degrees_of_freedom, 9);
}

TEST(LeastSquares, RefusesAsManyUnknownsAsRows) {
  EXPECT_THROW(least_squares(Eigen::MatrixXd::Identity(2, 2), Eigen::Vector2d::Ones()),
               std::invalid_argument);
}

/// J w' + mu w = u + bias under held commands, by many small steps of Heun's method: no closed form is used.
struct Spin {
  Eigen::VectorXd velocity, command;
};
Spin spin(double J, double mu, double bias, double period) {
  const Eigen::Index samples = 400;
  const int parts = 400;
  Spin run{Eigen::VectorXd::Zero(samples), Eigen::VectorXd::Zero(samples)};
  double w = 0.0;
  for (Eigen::Index k = 0; k < samples; ++k) {
    run.velocity[k] = w;
    run.command[k] = std::sin(0.13 * static_cast<double>(k));
    const auto rate = [&](double v) { return (run.command[k] + bias - mu * v) / J; };
    for (int i = 0; i < parts; ++i) {
      const double h = period / parts;
      const double guess = w + h * rate(w);
      w += 0.5 * h * (rate(w) + rate(guess));
    }
  }
  return run;
}

TEST(FirstOrderArx, FindsBiasInertiaAndFriction) {
  const double J = 5.5e-4;
  const double mu = 2.3e-3;
  const double bias = -0.0465;
  const Spin run = spin(J, mu, bias, 0.01);
  const Regression found = first_order_arx(run.velocity, run.command, 0.01);
  EXPECT_NEAR(found.values[0], bias, 1e-6 * std::abs(bias));  // Heun's error: (mu h/J)^2/6 is 2e-9
  EXPECT_NEAR(found.values[1], J, 1e-6 * J);
  EXPECT_NEAR(found.values[2], mu, 1e-6 * mu);
}

// The deviations must be those of the scatter: white noise of known size on the right-hand side of S1, many
// times.
TEST(FirstOrderArx, ItsDeviationsAreThoseOfTheScatter) {
  const double a = 0.96;
  const double b1 = 18.0;
  const double b2 = -0.8;
  std::uint64_t state = 1;
  const auto uniform = [&] {  // a linear congruential generator (Knuth's MMIX) is random enough here
    state = 6364136223846793005ULL * state + 1442695040888963407ULL;
    return static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
  };
  const int runs = 400;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d promised = Eigen::Vector3d::Zero();
  for (int run = 0; run < runs; ++run) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(300);
    Eigen::VectorXd u(300);
    for (Eigen::Index k = 0; k < 300; ++k) {
      u[k] = std::sin(0.2 * static_cast<double>(k));
      if (k > 0) {
        y[k] = a * y[k - 1] + b1 * u[k - 1] + b2 + 3.0 * uniform();
      }
    }
    const Regression found = first_order_arx(y, u, 0.01);
    sum += found.values;
    squares += found.values.cwiseAbs2();
    promised += found.covariance.diagonal();
  }
  const Eigen::Vector3d variance = squares / runs - (sum / runs).cwiseAbs2();
  for (int i = 0; i < 3; ++i) {  // the scatter of 400 runs is known to 3.5 %; four times that
    EXPECT_NEAR(std::sqrt(promised[i] / runs / variance[i]), 1.0, 0.14) << i;
  }
}

TEST(FirstOrderArx, RefusesAVelocityThatNeverDecays) {
  Eigen::VectorXd y(50);
  for (Eigen::Index k = 0; k < 50; ++k) {
    y[k] = std::pow(1.1, static_cast<double>(k)) + 0.01 * static_cast<double>(k % 3);
  }
  EXPECT_THROW(first_order_arx(y, Eigen::VectorXd::LinSpaced(50, 0.0, 1.0), 0.01), std::runtime_error);
}

// Two experiments decide it by hand: alpha_torque = dJ_exp/dJ_pulley, and alpha_rotor from either row. The
// numbers are round: rotor 4, pulleys 1 and 3, alpha_torque 1.25, alpha_rotor 0.8 give lumped inertias 5.25
// and 7.75.
TEST(Equation14, TwoExperimentsByHand) {
  const Regression found =
      equation_14(4.0, Eigen::Vector2d(1.0, 3.0), Eigen::Vector2d(5.25, 7.75), Eigen::Vector2d(0.1, 0.1));
  EXPECT_NEAR(found.values[0], 1.25, 1e-12);
  EXPECT_NEAR(found.values[1], 0.8, 1e-12);
  // alpha_torque = (J2 - J1)/2: variance 2 * 0.1^2/4.
  EXPECT_NEAR(std::sqrt(found.covariance(0, 0)), 0.1 / std::sqrt(2.0), 1e-12);
}

// A third one off the line: weighted least squares follows the better ones.
TEST(Equation14, FollowsTheMoreCertainExperiments) {
  const Eigen::Vector3d pulleys(1.0, 3.0, 2.0);
  const Eigen::Vector3d lumped(5.25, 7.75, 7.0);
  const Regression found = equation_14(4.0, pulleys, lumped, Eigen::Vector3d(1e-4, 1e-4, 1.0));
  EXPECT_NEAR(found.values[0], 1.25, 1e-6);
  EXPECT_NEAR(found.values[1], 0.8, 1e-6);
}

// Park et al. Figure 17: the line of the left leg, under a weight of 637 N.
TEST(Equation22, FindsTheLineOfFigure17) {
  const Eigen::VectorXd spring = Eigen::VectorXd::LinSpaced(10, 0.1, 0.5);
  const Eigen::VectorXd weight = Eigen::VectorXd::Constant(10, 637.0);
  Eigen::VectorXd leg_shape(10);
  for (Eigen::Index i = 0; i < 10; ++i) {
    leg_shape[i] = -std::asin(5.18 * (115.1 * spring[i] + 2.214) / 637.0);  // either sense
  }
  const Regression found = equation_22(leg_shape, spring, weight, 5.18);
  EXPECT_NEAR(found.values[0], 115.1, 1e-9);
  EXPECT_NEAR(found.values[1], 2.214, 1e-9);
}

TEST(Groups, PickAndAverage) {
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(5, 0.0, 4.0);
  EXPECT_EQ(every_nth(values, 2), Eigen::Vector3d(0.0, 2.0, 4.0));
  EXPECT_EQ(group_means(values, 2), Eigen::Vector3d(0.5, 2.5, 4.0));
}

}  // namespace
}  // namespace plumbline::validation
