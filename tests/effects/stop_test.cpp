// The hard stop against hand calculations with Table VIII of Park et al. (2011): K_d1 = 100 N m/rad^3,
// K_vd2 = 50 N m/(rad/s)^0.5. K_vd1 is not readable there; 2 N m s/rad stands in for it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

class HardStopTest : public testing::Test {
 protected:
  std::shared_ptr<const ForceLaw> law =
      std::dynamic_pointer_cast<const ForceLaw>(Catalogue::all().find("hard_stop"));

  Values stop(double position, double side) const {
    return values_of(*law, {{"cubic_stiffness", 100.0},
                            {"damping", 2.0},
                            {"root_damping", 50.0},
                            {"position", position},
                            {"side", side},
                            {"pulls", 1.0}});
  }
  double force(double x, double v, const Values& p) const { return law->force({x, v, 0}, nullptr, p.data()); }
};

// Equation 28 for q_Bsp <= 0, that is a stop at 0 with side -1, without the spring's own term:
// - K_d1 q^3 - K_vd1 q' and, moving in (q' < 0), - K_vd2 sqrt|q'| sgn(q').
TEST_F(HardStopTest, GivesTheTorquesOfTableEight) {
  const Values p = stop(0.0, -1.0);
  EXPECT_EQ(force(0.1, -4.0, p), 0.0);
  EXPECT_NEAR(force(-0.1, 0.0, p), 0.1, 1e-12);
  EXPECT_NEAR(force(-0.2, 0.0, p), 0.8, 1e-12);
  EXPECT_NEAR(force(-0.1, -4.0, p), 0.1 + 8.0 + 100.0, 1e-12);  // 50 sqrt(4) = 100
  EXPECT_NEAR(force(-0.1, 4.0, p), 0.1 - 8.0, 1e-12);           // moving out: no root term
}

// Rubber, or the plain penalty of a simulator: Hooke's law and a dashpot, beside the cubic term.
TEST_F(HardStopTest, MayBeLinear) {
  Values p = values_of(*law, {{"stiffness", 300.0}, {"damping", 2.0}, {"position", 0.5}, {"side", 1.0}});
  EXPECT_NEAR(force(0.51, 0.0, p), -3.0, 1e-12);
  EXPECT_NEAR(force(0.51, 4.0, p), -3.0 - 8.0, 1e-12);
  EXPECT_EQ(force(0.49, 4.0, p), 0.0);
  EXPECT_NEAR(law->stored_energy({0.6, 0.0, 0.0}, nullptr, p.data()), 0.5 * 300.0 * 0.01, 1e-12);
  EXPECT_FALSE(law->is_null(p.data()));
  p = values_of(*law, {{"position", 0.5}});
  EXPECT_TRUE(law->is_null(p.data()));
}

TEST_F(HardStopTest, IsItsOwnMirrorImage) {
  const Values above = stop(0.7, 1.0);
  const Values below = stop(-0.7, -1.0);
  for (const double x : {0.6, 0.8, 0.95}) {
    for (const double v : {-3.0, 0.0, 2.0}) EXPECT_DOUBLE_EQ(force(x, v, above), -force(-x, -v, below));
  }
}

// The root's numbers scale with the reference speed as sqrt.
TEST_F(HardStopTest, TakesTheRootRelativeToItsSpeed) {
  Values p = values_of(*law, {{"root_damping", 50.0}, {"root_speed", 4.0}});
  EXPECT_NEAR(force(0.1, 4.0, p), -50.0, 1e-12);
  EXPECT_NEAR(force(0.1, 1.0, p), -25.0, 1e-12);
}

// With a rounding the root begins with the slope K / (2 sqrt(rounding * root_speed)), and nothing happens
// where motion turns; far above it the root is lower by a constant.
TEST_F(HardStopTest, MayRoundTheRoot) {
  const Values p =
      values_of(*law, {{"root_damping", 50.0}, {"root_speed", 4.0}, {"rounding", 0.01}, {"pulls", 1.0}});
  EXPECT_NEAR(force(0.1, 1e-7, p), -50.0 * 1e-7 / 0.4, 1e-10);
  EXPECT_NEAR(force(0.1, 0.08, p), -50.0 * (0.15 - 0.05), 1e-12);
  EXPECT_NEAR(force(0.1, 99.99, p), -50.0 * (5.0 - 0.05), 1e-12);
  EXPECT_EQ(force(0.1, -1.0, p), 0.0);
  std::vector<double> in;
  std::vector<double> out;
  law->switches({0.1, 1.0, 0}, p.data(), in);
  law->switches({0.1, -1.0, 0}, p.data(), out);
  EXPECT_EQ(in, out);
}

TEST_F(HardStopTest, SwitchesAtTheStopAndWhereMotionTurnsInIt) {
  const Values p = stop(0.5, 1.0);
  const auto switches = [&](double x, double v) {
    std::vector<double> g;
    law->switches({x, v, 0}, p.data(), g);
    return g;
  };
  EXPECT_LT(switches(0.4, 1.0)[0], 0.0);
  EXPECT_GT(switches(0.6, 1.0)[0], 0.0);
  EXPECT_GT(switches(0.6, 1.0)[1], 0.0);
  EXPECT_LT(switches(0.6, -1.0)[1], 0.0);
  EXPECT_EQ(switches(0.4, 1.0), switches(0.4, -1.0));  // turning outside is no event
}

// A ball on rubber (300 N/m, 2 N s/m) that is thrown back: Hooke and the dashpot while it pushes, nothing
// once the rubber comes back more slowly than the ball leaves.
TEST_F(HardStopTest, NeverPullsWhereItIsNotGlued) {
  const auto rubber = [&](double pulls) {
    return values_of(*law, {{"stiffness", 300.0}, {"damping", 2.0}, {"position", 0.5}, {"pulls", pulls}});
  };
  const Values p = rubber(0.0);
  EXPECT_NEAR(force(0.51, 4.0, p), -3.0 - 8.0, 1e-12);
  EXPECT_NEAR(force(0.51, -1.0, p), -3.0 + 2.0, 1e-12);
  EXPECT_EQ(force(0.51, -4.0, p), 0.0);
  EXPECT_NEAR(force(0.51, -4.0, rubber(1.0)), 5.0, 1e-12) << "glued";
  // The 3 N of the rubber do no work on the ball any more: they are lost in it, at 4 m/s.
  EXPECT_NEAR(law->dissipated_power({0.51, -4.0, 0}, nullptr, p.data()), 12.0, 1e-12);
  EXPECT_NEAR(law->dissipated_power({0.51, -1.0, 0}, nullptr, p.data()), 2.0, 1e-12);
  const auto parting = [&](double v) {
    std::vector<double> g;
    law->switches({0.51, v, 0}, p.data(), g);
    return g.back();
  };
  EXPECT_EQ(law->jumps(p.data()), 1) << "at the edge; where the surfaces part the force is 0 on both sides";
  EXPECT_GT(parting(-1.49), 0.0);
  EXPECT_LT(parting(-1.51), 0.0);
}

// Thrown against a damped spring of 300 N/m and 20 N s/m, 1 kg parts where the push of
// x(t) = v0/w exp(-s t) sin(w t), the damped oscillation of a textbook, comes to 0, and flies on at what
// speed it has there.
TEST_F(HardStopTest, ThrowsBackWhatADampedSpringThrowsUntilItWouldPull) {
  const Values p = values_of(*law, {{"stiffness", 300.0}, {"damping", 20.0}, {"pulls", 0.0}});
  const double s = 10.0, w = std::sqrt(300.0 - s * s), v0 = 2.0;
  // push = 300 x + 20 x' = 0: tan(w t) = 2 s w/(s^2 - w^2), in the second quarter of the wave.
  const double t_part = std::atan2(2.0 * s * w, s * s - w * w) / w;
  const double v_part = v0 * std::exp(-s * t_part) * (std::cos(w * t_part) - s / w * std::sin(w * t_part));
  double x = 0.0, v = v0;
  const double h = 1e-5;  // semi-implicit Euler: its error is of the order of h
  for (double t = 0.0; t < 0.5; t += h) {
    v += h * force(x, v, p);
    x += h * v;
  }
  EXPECT_NEAR(v, v_part, 1e-3);
  EXPECT_LT(v, 0.0);
}

TEST_F(HardStopTest, IsNullWhereverItWouldBe) {
  EXPECT_TRUE(law->is_null(values_of(*law, {{"position", 0.4}, {"side", -1.0}}).data()));
  EXPECT_FALSE(law->is_null(values_of(*law, {{"damping", 0.1}}).data()));
}

}  // namespace
}  // namespace plumbline::effects
