// LuGre friction against the closed forms of Canudas de Wit, Olsson, Astrom and Lischinsky (1995) and the
// passivity condition of Barabanov and Ortega (2000).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/effects/rk4.h"
#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

// The values of the 1995 paper's Table I (mass 1 kg, linear motion).
constexpr double kSigma0 = 1e5, kSigma1 = 316.22776601683796, kSigma2 = 0.4;
constexpr double kCoulomb = 1.0, kStatic = 1.5, kStribeckSpeed = 0.001;

class LuGreTest : public testing::Test {
 protected:
  std::shared_ptr<const ForceLaw> law =
      std::dynamic_pointer_cast<const ForceLaw>(Catalogue::all().find("lugre"));
  Values p = values_of(*law, {{"level", kCoulomb},
                              {"rise", kStatic - kCoulomb},
                              {"stribeck_speed", kStribeckSpeed},
                              {"stiffness", kSigma0},
                              {"bristle_damping", kSigma1},
                              {"viscous", kSigma2}});

  State slide(double v, double duration, int steps, double z0 = 0.0) const {
    return rk4(
        [&](const State& z) {
          State rate(1);
          law->state_rate({0, v, 0}, z.data(), p.data(), rate.data());
          return rate;
        },
        {z0}, duration, steps);
  }
};

// Steady sliding: F = g(v) sgn(v) + sigma_2 v.
TEST_F(LuGreTest, SlidesSteadilyOnTheStribeckCurve) {
  for (const double v : {-0.01, -0.001, -0.0002, 0.0002, 0.001, 0.003, 0.1}) {
    const double g = kCoulomb + (kStatic - kCoulomb) * std::exp(-std::pow(v / kStribeckSpeed, 2));
    const double settling_time = g / (kSigma0 * std::abs(v));
    const State z = slide(v, 40 * settling_time, 4000);
    const double expected = -(std::copysign(g, v) + kSigma2 * v);
    EXPECT_NEAR(law->force({0, v, 0}, z.data(), p.data()), expected, 1e-9) << v;
  }
}

// At constant velocity the bristles approach g/sigma_0 as 1 - exp(-sigma_0 |v| t / g).
TEST_F(LuGreTest, ApproachesSteadySlidingExponentially) {
  const double v = 0.01;  // ten Stribeck speeds: g is the Coulomb level
  const double time = 1.3e-3;
  const double expected = kCoulomb / kSigma0 * (1 - std::exp(-kSigma0 * v * time / kCoulomb));
  EXPECT_NEAR(slide(v, time, 2000)[0], expected, 1e-12);
}

// Before sliding the bristles are a spring: dF/dx = sigma_0 for motions well below F_S/sigma_0 = 15 um.
TEST_F(LuGreTest, IsASpringBeforeSliding) {
  const double v = 1e-6, time = 0.05;  // 0.05 um
  const State z = slide(v, time, 1000);
  const double force = -law->force({0, 0, 0}, z.data(), p.data());
  EXPECT_NEAR(force / (v * time), kSigma0,
              0.005 * kSigma0);  // 0.05 um / 15 um: 0.3 % off, halved by averaging
}

// |z| <= F_S/sigma_0 is never left.
TEST_F(LuGreTest, KeepsItsBristlesInRange) {
  const double range = kStatic / kSigma0;
  for (const double v : {-0.1, -1e-3, -1e-4, 1e-4, 1e-3, 0.1}) {
    State rate(1);
    for (const double edge : {-range, range}) {
      law->state_rate({0, v, 0}, &edge, p.data(), rate.data());
      EXPECT_LE(rate[0] * edge, 1e-12);
    }
  }
}

// Passive when sigma_2 >= sigma_1 (F_S - F_C)/F_C; not so without viscous friction.
TEST_F(LuGreTest, IsPassiveWhereTheNoteSaysSo) {
  const auto smallest_loss = [&](double viscous) {
    const Values q = values_of(*law, {{"level", kCoulomb},
                                      {"rise", kStatic - kCoulomb},
                                      {"stribeck_speed", kStribeckSpeed},
                                      {"stiffness", kSigma0},
                                      {"bristle_damping", kSigma1},
                                      {"viscous", viscous}});
    double smallest = 1e9;
    for (int i = -50; i <= 50; ++i) {
      const double z = kStatic / kSigma0 * i / 50.0;
      for (int k = -60; k <= 60; ++k) {
        if (k == 0) continue;
        const double v = std::copysign(std::pow(10.0, -6.0 + std::abs(k) / 10.0), k);
        smallest = std::min(smallest, law->dissipated_power({0, v, 0}, &z, q.data()) / std::abs(v));
      }
    }
    return smallest;
  };
  const double bound = kSigma1 * (kStatic - kCoulomb) / kCoulomb;
  EXPECT_GE(smallest_loss(bound), -1e-12);
  EXPECT_LT(smallest_loss(0.5 * bound), -1e-3);
}

// A mass on bristles only: frequency sqrt(sigma_0/m); the starts span strengths and presliding deflections.
TEST_F(LuGreTest, StartsLightlyDampedOverManyStrengthsAndDeflections) {
  const Scales scales = test_scales();
  double weakest = 1e300;
  double strongest = 0.0;
  for (const auto& start : law->starts(scales)) {
    const auto value = [&](const char* name) {
      return start[static_cast<std::size_t>(law->parameter_index(name))];
    };
    EXPECT_NEAR(value("bristle_damping") / (2 * std::sqrt(value("stiffness") * scales.inertia)), 0.1, 1e-12);
    weakest = std::min(weakest, value("level") / scales.force);
    strongest = std::max(strongest, value("level") / scales.force);
    EXPECT_GE(value("level") / value("stiffness"), 0.0499 * scales.position);
    EXPECT_LE(value("level") / value("stiffness"), 0.4001 * scales.position);
  }
  EXPECT_LE(weakest, 0.002);
  EXPECT_GE(strongest, 0.05);
}

TEST_F(LuGreTest, WithoutBristlesOnlySlidesViscously) {
  const Values q = values_of(*law, {{"viscous", 0.3}});
  const double z = 0.5;
  double rate = 1.0;
  law->state_rate({0, 2.0, 0}, &z, q.data(), &rate);
  EXPECT_EQ(rate, 0.0);
  EXPECT_DOUBLE_EQ(law->force({0, 2.0, 0}, &z, q.data()), -0.6);
  EXPECT_FALSE(law->is_null(q.data()));
}

TEST_F(LuGreTest, StaysFiniteWhenTheRiseFadesToNothing) {
  const Values q = values_of(*law, {{"rise", 0.5}, {"stribeck_speed", 0.001}, {"stiffness", 1e3}});
  const double z = 0.0;
  double rate = 0.0;
  law->state_rate({0, 10.0, 0}, &z, q.data(), &rate);
  EXPECT_TRUE(std::isfinite(rate));
}

}  // namespace
}  // namespace plumbline::effects
