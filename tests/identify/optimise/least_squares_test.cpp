// Constrained least squares beside closed forms.
#include "validation/identify/optimise/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::validation {
namespace {

/// The point of the unit circle nearest to (1.2, 0.8), with x at most `most`.
LeastSquares nearest_on_circle(double most) {
  LeastSquares p;
  p.start = Eigen::Vector2d(0.1, 0.9);
  p.lower = Eigen::Vector2d(-5.0, -5.0);
  p.upper = Eigen::Vector2d(5.0, 5.0);
  p.scale = Eigen::Vector2d(2.0, 0.5);
  p.residuals = 2;
  p.equalities = 1;
  p.inequalities = 1;
  p.evaluate = [most](const Eigen::VectorXd& x, LeastSquares::Values& values) {
    values.residuals = x - Eigen::Vector2d(1.2, 0.8);
    values.equalities = Eigen::VectorXd::Constant(1, x.squaredNorm() - 1.0);
    values.inequalities = Eigen::VectorXd::Constant(1, most - x[0]);
    return true;
  };
  return p;
}

TEST(LeastSquares, FindsTheNearestPointOfACircle) {
  const LeastSquaresResult free = solve(nearest_on_circle(2.0));
  EXPECT_TRUE(free.solved && free.feasible);
  EXPECT_NEAR(free.x[0], 3.0 / std::sqrt(13.0), 1e-6);
  EXPECT_NEAR(free.x[1], 2.0 / std::sqrt(13.0), 1e-6);
  const LeastSquaresResult held = solve(nearest_on_circle(0.5));
  EXPECT_TRUE(held.solved);
  EXPECT_NEAR(held.x[0], 0.5, 1e-6);
  EXPECT_NEAR(held.x[1], std::sqrt(0.75), 1e-6);
}

TEST(LeastSquares, SaysThatConstraintsCannotBeMet) {
  const LeastSquaresResult none = solve(nearest_on_circle(-1.5));
  EXPECT_FALSE(none.solved);
  EXPECT_FALSE(none.feasible);
  EXPECT_FALSE(none.status.empty());
}

// Where a point has no value the step is cut: here beyond x = 0.7, which lies between start and minimum's far
// side.
TEST(LeastSquares, GoesAroundPointsWithoutAValue) {
  LeastSquares p = nearest_on_circle(0.5);
  const auto all = p.evaluate;
  p.evaluate = [all](const Eigen::VectorXd& x, LeastSquares::Values& values) {
    return all(x, values) && x[0] < 0.7;
  };
  const LeastSquaresResult result = solve(p);
  EXPECT_NEAR(result.x[0], 0.5, 1e-5);
}

}  // namespace
}  // namespace plumbline::validation
