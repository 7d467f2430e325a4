// The words and guards that the laws share.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

TEST(Guarded, KeepsGoodScalesAndReplacesBadOnes) {
  const Scales good{0.5, 3.0, 2.0, 1e-4, 1e-3, -0.2};
  const Scales kept = guarded(good);
  EXPECT_EQ(kept.position, 0.5);
  EXPECT_EQ(kept.velocity, 3.0);
  EXPECT_EQ(kept.force, 2.0);
  EXPECT_EQ(kept.inertia, 1e-4);
  EXPECT_EQ(kept.period, 1e-3);
  EXPECT_EQ(kept.center, -0.2);
  const double nan = std::nan("");
  const Scales replaced = guarded({0.0, -1.0, nan, kInfinity, 0.0, nan});
  EXPECT_EQ(replaced.position, 1.0);
  EXPECT_EQ(replaced.velocity, 1.0);
  EXPECT_EQ(replaced.force, 1.0);
  EXPECT_EQ(replaced.inertia, 1.0);
  EXPECT_EQ(replaced.period, 1.0);
  EXPECT_EQ(replaced.center, 0.0);
}

TEST(SmoothSign, IsOddBoundedAndSharpensWithItsSpeed) {
  EXPECT_EQ(smooth_sign(0.0, 0.1), 0.0);
  EXPECT_EQ(smooth_sign(0.0, 0.0), 0.0);
  EXPECT_EQ(smooth_sign(-0.3, 0.0), -1.0);
  EXPECT_DOUBLE_EQ(smooth_sign(-0.2, 0.1), -smooth_sign(0.2, 0.1));
  EXPECT_NEAR(smooth_sign(1e-6, 0.1), 1e-5, 1e-12);
  EXPECT_DOUBLE_EQ(smooth_sign(5.0, 0.1), 1.0);
}

TEST(SmoothingSpeed, IsASmallShareOfTheVelocity) {
  Scales scales;
  scales.velocity = 4.0;
  EXPECT_DOUBLE_EQ(smoothing_speed_for(scales), 0.008);
}

}  // namespace
}  // namespace plumbline::effects
