#include "validation/identify/standard/bounded_minimum.h"

#include <gtest/gtest.h>

namespace plumbline::validation {
namespace {

// min (d1 - 3)^2 + (d2 - 1)^2 + d1 d2, H = [2 1; 1 2], g = (6, 2): free at (10/3, -2/3).
const Eigen::Matrix2d kH = (Eigen::Matrix2d() << 2.0, 1.0, 1.0, 2.0).finished();
const Eigen::Vector2d kG(6.0, 2.0);

TEST(BoundedMinimum, IsTheFreeOneWithinWideBounds) {
  const BoundedMinimum found =
      bounded_minimum(kH, kG, Eigen::Vector2d::Constant(-10.0), Eigen::Vector2d::Constant(10.0));
  EXPECT_NEAR(found.at[0], 10.0 / 3.0, 1e-12);
  EXPECT_NEAR(found.at[1], -2.0 / 3.0, 1e-12);
  EXPECT_FALSE(found.held[0] || found.held[1]);
}

// With d2 held at nought the other is alone: 2 d1 = 6.
TEST(BoundedMinimum, LetsTheOthersMoveOnWhereOneIsHeld) {
  const BoundedMinimum found =
      bounded_minimum(kH, kG, Eigen::Vector2d(-10.0, 0.0), Eigen::Vector2d(10.0, 10.0));
  EXPECT_NEAR(found.at[0], 3.0, 1e-12);
  EXPECT_EQ(found.at[1], 0.0);
  EXPECT_TRUE(found.held[1]);
}

// Both bounds are met on the way, and one is let go again: (2, 0), where the slope by d2 is 2 - 2 = 0.
TEST(BoundedMinimum, ReleasesWhatWasHeldTooEarly) {
  const BoundedMinimum found =
      bounded_minimum(kH, kG, Eigen::Vector2d(-10.0, -5.0), Eigen::Vector2d(2.0, 10.0));
  EXPECT_NEAR(found.at[0], 2.0, 1e-12);
  EXPECT_NEAR(found.at[1], 0.0, 1e-12);
}

}  // namespace
}  // namespace plumbline::validation
