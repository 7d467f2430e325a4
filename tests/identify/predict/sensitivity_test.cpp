// Deviations carried over a piece that is far stiffer than it is long.
#include "validation/identify/predict/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::validation {
namespace {

/// A damper of rate lambda, driven by a parameter that adds 1 to the acceleration: in closed form
///   v = v0 e + (1 - e)/lambda,  x = x0 + v0 (1 - e)/lambda + (h - (1 - e)/lambda)/lambda,  e = exp(-lambda
///   h).
class DampedPiece : public testing::TestWithParam<double> {
 protected:
  static constexpr double kLength = 1e-3;
  static constexpr double kThrown = 1e6;  // velocity behind a jump, for 1 of position

  Sensitivity carried(int parts) const {
    Eigen::Matrix3d start = Eigen::Matrix3d::Zero();  // d(x, v, -)/d(thrown, -, parameter)
    start(0, 0) = 1.0;
    start(1, 0) = kThrown;
    Sensitivity sensitivity(start);
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    A(0, 1) = 1.0;
    A(1, 1) = -GetParam();
    sensitivity.step(kLength, A, Eigen::Vector3d(0.0, 1.0, 0.0), parts);
    return sensitivity;
  }
};

TEST_P(DampedPiece, InPartsEndsWhereTheClosedFormDoes) {
  const double lambda = GetParam();
  const double gone = -std::expm1(-lambda * kLength);
  Sensitivity four = carried(4);
  constexpr double kLeft = 2e-5;
  EXPECT_NEAR(four.S()(0, 0), 1.0 + kThrown * gone / lambda, kLeft * kThrown / lambda);
  EXPECT_NEAR(four.S()(1, 0), kThrown * (1.0 - gone), kLeft * kThrown);
  EXPECT_NEAR(four.S()(0, 2), (kLength - gone / lambda) / lambda, kLeft * kLength / lambda);
  EXPECT_NEAR(four.S()(1, 2), gone / lambda, kLeft / lambda);
  EXPECT_EQ(four.before()(1, 0), kThrown);
}

/// A (h mean) = S - before - h B holds for the whole piece as it does for one part.
TEST_P(DampedPiece, TheMeanBelongsToTheSameStep) {
  Sensitivity four = carried(4);
  const Eigen::MatrixXd mean = four.mean();
  const double change = four.S()(1, 0) - kThrown;
  EXPECT_NEAR(-GetParam() * kLength * mean(1, 0), change, 1e-9 * kThrown);
  EXPECT_NEAR(kLength * mean(1, 0), four.S()(0, 0) - 1.0, 1e-9 * kThrown * kLength);
}

INSTANTIATE_TEST_SUITE_P(Rates, DampedPiece, testing::Values(10.0, 1e3, 1e5, 1e7));

}  // namespace
}  // namespace plumbline::validation
