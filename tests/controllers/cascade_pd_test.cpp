#include "controllers/blocks/cascade_pd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace plumbline::controllers {
namespace {

TEST(CascadePd, FollowsItsEquationByHand) {
  CascadePd controller({4.0, 10.0, 0.0, 0.5});
  EXPECT_DOUBLE_EQ(controller.command(1.0, 0.5), 20.0);        // 10 (4 * 0.5), no velocity yet
  EXPECT_DOUBLE_EQ(controller.command(1.0, 0.75), 5.0);        // 10 (4 * 0.25 - 0.25 / 0.5)
  EXPECT_DOUBLE_EQ(controller.command(1.0, 1.0, 2.0), -3.0);   // 10 (0 - 0.5) + 2
  EXPECT_DOUBLE_EQ(controller.command(1.0, 1.0, -1.5), -1.5);  // at rest in the reference: the disturbance
}

TEST(CascadePd, LimitHoldsTheWholeCommand) {
  CascadePd controller({4.0, 10.0, 6.0, 0.5});
  EXPECT_DOUBLE_EQ(controller.command(1.0, 0.0), 6.0);
  controller.reset();
  EXPECT_DOUBLE_EQ(controller.command(-1.0, 0.0), -6.0);
  controller.reset();
  EXPECT_DOUBLE_EQ(controller.command(0.1, 0.0, 50.0), 6.0);  // the disturbance too
  controller.reset();
  EXPECT_DOUBLE_EQ(controller.command(0.1, 0.0, 1.0), 5.0);  // inside: untouched
}

TEST(CascadePd, ResetForgetsTheVelocity) {
  CascadePd controller({4.0, 10.0, 0.0, 0.5});
  controller.command(0.0, 7.0);
  controller.reset();
  EXPECT_DOUBLE_EQ(controller.command(0.0, 1.0), -40.0);
  controller.reset(0.5);
  EXPECT_DOUBLE_EQ(controller.command(0.0, 1.0), -50.0);
}

TEST(CascadePd, DifferenceOverTwoSamplesByHand) {
  CascadePd controller({4.0, 10.0, 0.0, 0.5, 2});
  EXPECT_DOUBLE_EQ(controller.command(1.0, 0.5), 20.0);   // 10 (4 * 0.5), no velocity yet
  EXPECT_DOUBLE_EQ(controller.command(1.0, 0.75), 5.0);   // 10 (4 * 0.25 - 0.25 / 0.5): one sample is known
  EXPECT_DOUBLE_EQ(controller.command(1.0, 2.0), -55.0);  // 10 (-4 - (2 - 0.5) / 1)
  EXPECT_DOUBLE_EQ(controller.command(1.0, 0.5), 22.5);   // 10 (2 - (0.5 - 0.75) / 1)
}

TEST(CascadePd, StartsInMotion) {
  for (const int samples : {1, 2}) {
    CascadePd controller({4.0, 10.0, 0.0, 0.5, samples});
    controller.reset(1.0, 3.0);
    EXPECT_DOUBLE_EQ(controller.command(1.0, 1.0), -30.0);  // 10 (0 - 3)
  }
}

// On an inertia J with small T the loop is J y'' = kv (kp (r - y) - y'): natural frequency sqrt(kv kp / J),
// damping ratio sqrt(kv / (kp J)) / 2 (any textbook on control). With kp = kv/(4 J) it is critically damped:
// y = r (1 - (1 + w t) exp(-w t)), w = kv / (2 J).
TEST(CascadePd, CriticallyDampedStepOnAnInertia) {
  const double inertia = 2.0, kv = 40.0, period = 1e-5;
  const double kp = kv / (4 * inertia), w = kv / (2 * inertia);
  CascadePd controller({kp, kv, 0.0, period});
  double y = 0, velocity = 0;
  for (int k = 0; k < 100000; ++k) {
    const double acceleration = controller.command(1.0, y) / inertia;
    y += velocity * period + 0.5 * acceleration * period * period;
    velocity += acceleration * period;
    if (k % 10000 == 9999) {
      const double t = (k + 1) * period;
      ASSERT_NEAR(y, 1 - (1 + w * t) * std::exp(-w * t), 1e-4);
    }
  }
}

TEST(CascadePd, RefusesImpossibleOptions) {
  EXPECT_THROW(CascadePd({std::nan(""), 1, 0, 1e-3}), std::invalid_argument);
  EXPECT_THROW(CascadePd({1, HUGE_VAL, 0, 1e-3}), std::invalid_argument);
  EXPECT_THROW(CascadePd({1, 1, -1, 1e-3}), std::invalid_argument);
  EXPECT_THROW(CascadePd({1, 1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(CascadePd({1, 1, 0, 1e-3, 0}), std::invalid_argument);
  EXPECT_THROW(CascadePd({1, 1, 0, 1e-3, 3}), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::controllers
