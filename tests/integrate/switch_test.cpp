// Switching functions are located where the closed form says.
#include <gtest/gtest.h>

#include "simulator/integrate/switch_search.h"
#include "tests/integrate/problems.h"

namespace plumbline::integrate {
namespace {

constexpr double kPi = 3.14159265358979323846;

class Switches : public testing::TestWithParam<Method> {};

/// x'' = -sign(x): every quarter is a parabola. From (1, 0): x = 0 first at sqrt(2), then every 2 sqrt(2).
class Relay : public Ode {
 public:
  int size() const override { return 2; }
  void rate(double /*t*/, const double* x, double* xdot) override {
    xdot[0] = x[1];
    xdot[1] = x[0] > 0.0 ? -1.0 : 1.0;
  }
  int switch_count() const override { return 1; }
  void switches(double /*t*/, const double* x, double* g) override { g[0] = x[0]; }
};

TEST_P(Switches, OfARelayAreWhereTheParabolasEnd) {
  Relay relay;
  Integrator integrator(relay, with(GetParam(), 1e-12));
  integrator.start(0.0, Eigen::Vector2d(1.0, 0.0));
  integrator.advance(10.0);
  ASSERT_EQ(integrator.events().size(), 4U);
  int direction = -1;
  double time = std::sqrt(2.0);
  for (const Event& event : integrator.events()) {
    EXPECT_NEAR(event.time, time, 1e-9);
    EXPECT_EQ(event.direction, direction);
    EXPECT_EQ(event.index, 0);
    direction = -direction;
    time += 2.0 * std::sqrt(2.0);
  }
  EXPECT_EQ(integrator.summary().switches_found, 4);
  EXPECT_EQ(integrator.summary().restarts, 4);
  // Parabola from the last crossing, where x' = sqrt(2).
  const double t = 10.0 - 7.0 * std::sqrt(2.0);
  EXPECT_NEAR(integrator.state()[0], std::sqrt(2.0) * t - 0.5 * t * t, 1e-8);
}

TEST_P(Switches, AreFoundStepByStepToo) {
  Relay relay;
  Integrator whole(relay, with(GetParam(), 1e-8));
  whole.start(0.0, Eigen::Vector2d(1.0, 0.0));
  whole.advance(10.0);
  Integrator single(relay, with(GetParam(), 1e-8));
  single.start(0.0, Eigen::Vector2d(1.0, 0.0));
  int calls = 0;
  while (single.time() < 10.0) {
    const double before = single.time();
    single.step(10.0);
    ASSERT_GT(single.time(), before);
    ++calls;
  }
  EXPECT_EQ(single.time(), 10.0);
  EXPECT_EQ(single.events().size(), 4U);
  EXPECT_GT(calls, 4);
  EXPECT_LE(calls, single.summary().steps);
  EXPECT_NEAR((single.state() - whole.state()).norm(), 0.0, 1e-6);
}

/// cos and sin, watched at several levels at once; nothing changes in the rate.
class Watched : public DrivenOscillator {
 public:
  Watched() : DrivenOscillator(1.0, 0.0) {}
  int switch_count() const override { return 3; }
  void switches(double /*t*/, const double* x, double* g) override {
    g[0] = x[0] - 0.5;
    g[1] = x[1] + 0.5;
    g[2] = x[0] - 2.0;
  }
};

// x = cos t crosses 0.5 at pi/3 and 5 pi/3, x' = -sin t crosses -0.5 at pi/6 and 5 pi/6. Here the steps are
// long and the dense output of a Runge-Kutta step would be far too coarse.
TEST_P(Switches, OfAnOscillatorAreWhereItsPhaseSays) {
  Watched watched;
  Integrator integrator(watched, with(GetParam(), 1e-11));
  integrator.start(0.0, Eigen::Vector2d(1.0, 0.0));
  integrator.advance(2.0 * kPi);
  const Event expected[] = {{kPi / 6, 1, -1}, {kPi / 3, 0, -1}, {5 * kPi / 6, 1, 1}, {5 * kPi / 3, 0, 1}};
  ASSERT_EQ(integrator.events().size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(integrator.events()[i].time, expected[i].time, 1e-9);
    EXPECT_EQ(integrator.events()[i].index, expected[i].index);
    EXPECT_EQ(integrator.events()[i].direction, expected[i].direction);
  }
  EXPECT_NEAR(integrator.state()[0], 1.0, 1e-8);
}

// The same found in short stretches: a switch is found once, also when it is close to a stop.
TEST_P(Switches, AreFoundOnceBetweenManyStops) {
  Watched watched;
  Integrator integrator(watched, with(GetParam(), 1e-9));
  integrator.start(0.0, Eigen::Vector2d(1.0, 0.0));
  for (int k = 1; k <= 6000; ++k) {
    integrator.input_changed(true);
    integrator.advance(k * kPi / 3000);
  }
  ASSERT_EQ(integrator.events().size(), 4U);
  EXPECT_NEAR(integrator.events()[0].time, kPi / 6, 1e-6);
  EXPECT_NEAR(integrator.events()[3].time, 5 * kPi / 3, 1e-6);
}

TEST_P(Switches, ThatAreZeroAtTheStartAreNotCounted) {
  Watched watched;
  Integrator integrator(watched, with(GetParam(), 1e-9));
  integrator.start(0.0, Eigen::Vector2d(0.5, std::sqrt(0.75)));  // cos and -sin of t - pi/3
  integrator.advance(1.0);
  EXPECT_TRUE(integrator.events().empty());
  integrator.advance(3.0);
  ASSERT_EQ(integrator.events().size(), 2U);
  EXPECT_NEAR(integrator.events()[0].time, kPi / 2, 1e-7);
  EXPECT_NEAR(integrator.events()[1].time, 2 * kPi / 3, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Methods, Switches,
                         testing::Values(Method::bdf, Method::implicit_rk, Method::explicit_rk),
                         [](const auto& tested) { return to_string(tested.param); });

// A function that is exactly zero at the upper end of a bracket of a hundred units in the last place: the
// guess must not round to that end, or the search would never finish.
TEST(SwitchBracketTest, AGuessIsStrictlyInside) {
  const double lo = 0.045152364098572338;
  const double hi = 0.045152364098573275;
  const SwitchBracket bracket(lo, Eigen::VectorXd::Constant(1, -1e-6), hi, Eigen::VectorXd::Zero(1));
  EXPECT_GT(bracket.guess(), lo);
  EXPECT_LT(bracket.guess(), hi);
}

}  // namespace
}  // namespace plumbline::integrate
