#include "validation/identify/predict/box_least_squares.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline::validation {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

TEST(BoxLeastSquares, InsideTheBoxItSolvesTheNormalEquations) {
  Eigen::MatrixXd H(2, 2);
  H << 4e6, 1e6, 1e6, 3e6;
  const Eigen::Vector2d wanted(0.5, -2.0);
  const Eigen::VectorXd d =
      box_least_squares(H, H * wanted, Eigen::Vector2d(-kFar, -kFar), Eigen::Vector2d(kFar, kFar));
  // The weak prior pulls by its precision over the data's: 1e-2 / 1e6.
  EXPECT_NEAR(d[0], wanted[0], 1e-7);
  EXPECT_NEAR(d[1], wanted[1], 1e-7);
}

TEST(BoxLeastSquares, OnTheBoundTheOtherUnknownsTakeOver) {
  // (d0 + d1 - 1)^2 + 1e-6 d1^2 style trade-off: with d0 held at 0.2, d1 must bring the rest (closed form).
  Eigen::MatrixXd H(2, 2);
  H << 1e6, 1e6, 1e6, 2e6;
  const Eigen::Vector2d g(1e6, 1e6);  // free minimum at d0 = 1, d1 = 0
  const Eigen::VectorXd d = box_least_squares(H, g, Eigen::Vector2d(0.0, -kFar), Eigen::Vector2d(0.2, kFar));
  EXPECT_NEAR(d[0], 0.2, 1e-6);
  EXPECT_NEAR(d[1], (1e6 - 1e6 * 0.2) / 2e6, 1e-6);
}

TEST(BoxLeastSquares, UnseenUnknownsStayWhereTheyAre) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, 2);
  H(0, 0) = 1e6;
  const Eigen::VectorXd d = box_least_squares(H, Eigen::Vector2d(1e6, 1e-9), Eigen::Vector2d(-kFar, -kFar),
                                              Eigen::Vector2d(kFar, kFar));
  EXPECT_NEAR(d[0], 1.0, 1e-6);
  EXPECT_NEAR(d[1], 0.0, 1e-6);
}

}  // namespace
}  // namespace plumbline::validation
