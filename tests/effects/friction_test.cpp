// Friction laws against closed forms: losses per cycle of x = X sin(w t), limits at low and high speed.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kAmplitude = 0.3;   // rad
constexpr double kFrequency = 11.0;  // rad/s

std::shared_ptr<const ForceLaw> law_named(const std::string& name) {
  return std::dynamic_pointer_cast<const ForceLaw>(Catalogue::all().find(name));
}

/// - integral of f dx over a cycle around `center`; the midpoint rule converges fast for periodic functions.
double cycle_loss(const ForceLaw& law, const Values& p, double frequency, double center = 0.0) {
  constexpr int kSteps = 200000;
  double loss = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double phase = 2 * kPi * (i + 0.5) / kSteps;
    const Motion m{center + kAmplitude * std::sin(phase), kAmplitude * frequency * std::cos(phase), 0.0};
    loss -= law.force(m, nullptr, p.data()) * m.velocity * (2 * kPi / frequency / kSteps);
  }
  return loss;
}

// Thomson, Theory of Vibration with Applications: pi c w X^2.
TEST(Viscous, LosesPiBOmegaXSquaredInACycle) {
  const auto law = law_named("viscous");
  const Values p = values_of(*law, {{"damping", 0.7}});
  EXPECT_NEAR(cycle_loss(*law, p, kFrequency), kPi * 0.7 * kFrequency * kAmplitude * kAmplitude, 1e-9);
}

// Den Hartog, Mechanical Vibrations: 4 F X for Coulomb friction.
TEST(Coulomb, LosesFourFXInACycle) {
  const auto law = law_named("coulomb");
  const Values p = values_of(*law, {{"level", 0.7}, {"smoothing_speed", 1e-5}});
  EXPECT_NEAR(cycle_loss(*law, p, kFrequency), 4 * 0.7 * kAmplitude, 1e-6);
}

// Thomson: equivalent damping of velocity-squared drag, (8/3) c w^2 X^3.
TEST(Quadratic, LosesEightThirdsInACycle) {
  const auto law = law_named("quadratic");
  const Values p = values_of(*law, {{"drag", 0.7}});
  EXPECT_NEAR(cycle_loss(*law, p, kFrequency),
              8.0 / 3.0 * 0.7 * kFrequency * kFrequency * std::pow(kAmplitude, 3), 1e-8);
}

// Reid 1956: 2 h X^2 in a cycle, whatever the frequency.
TEST(Hysteresis, LosesTheSameInACycleAtEveryFrequency) {
  const auto law = law_named("hysteresis");
  const Values p = values_of(*law, {{"loss", 0.7}, {"rest", 0.4}, {"smoothing_speed", 1e-5}});
  for (const double frequency : {1.0, 11.0, 50.0}) {
    EXPECT_NEAR(cycle_loss(*law, p, frequency, 0.4), 2 * 0.7 * kAmplitude * kAmplitude, 1e-5);
  }
}

// Armstrong-Helouvry et al. 1994: static level at low speed, Coulomb level at high speed.
TEST(Stribeck, GoesFromTheStaticToTheCoulombLevel) {
  const auto law = law_named("stribeck");
  const Values p =
      values_of(*law, {{"level", 2.0}, {"rise", 1.5}, {"stribeck_speed", 0.1}, {"smoothing_speed", 1e-6}});
  const auto force = [&](double v) { return law->force({0, v, 0}, nullptr, p.data()); };
  EXPECT_NEAR(force(1e-4), -3.5, 1e-5);
  EXPECT_NEAR(force(-1e-4), 3.5, 1e-5);
  EXPECT_NEAR(force(5.0), -2.0, 1e-12);
  EXPECT_NEAR(force(-5.0), 2.0, 1e-12);
  EXPECT_NEAR(force(0.1), -(2.0 + 1.5 * 0.36787944117144233), 1e-12);  // 1/e at the Stribeck speed
}

TEST(Stribeck, ContainsCoulomb) {
  const auto stribeck = law_named("stribeck");
  const auto coulomb = law_named("coulomb");
  const Values p = values_of(*stribeck, {{"level", 2.0}, {"smoothing_speed", 0.05}});
  const Values q = values_of(*coulomb, {{"level", 2.0}, {"smoothing_speed", 0.05}});
  for (const double v : {-1.0, -0.02, 0.0, 0.01, 3.0}) {
    EXPECT_DOUBLE_EQ(stribeck->force({0, v, 0}, nullptr, p.data()),
                     coulomb->force({0, v, 0}, nullptr, q.data()));
  }
}

// The two directions have b + d and b - d.
TEST(ViscousDirectional, AddsForwardsAndTakesBackwards) {
  const auto law = law_named("viscous_directional");
  const Values p = values_of(*law, {{"difference", 0.2}});
  EXPECT_DOUBLE_EQ(law->force({0, 3.0, 0}, nullptr, p.data()), -0.6);
  EXPECT_DOUBLE_EQ(law->force({0, -3.0, 0}, nullptr, p.data()), -0.6);  // helps motion that is negative
}

TEST(CoulombDirectional, AddsForwardsAndTakesBackwards) {
  const auto law = law_named("coulomb_directional");
  const Values p = values_of(*law, {{"difference", 0.2}, {"smoothing_speed", 1e-3}});
  EXPECT_NEAR(law->force({0, 3.0, 0}, nullptr, p.data()), -0.2, 1e-12);
  EXPECT_NEAR(law->force({0, -3.0, 0}, nullptr, p.data()), -0.2, 1e-12);
  EXPECT_DOUBLE_EQ(law->force({0, 0.0, 0}, nullptr, p.data()), 0.0);
}

// Amontons: in proportion to the load, whatever its sign, against the motion.
TEST(LoadFriction, FollowsTheLoad) {
  const auto law = law_named("load_friction");
  const Values p = values_of(*law, {{"coefficient", 0.1}, {"smoothing_speed", 1e-3}});
  for (const double load : {-5.0, 5.0}) {
    EXPECT_NEAR(law->force({0, 1.0, load}, nullptr, p.data()), -0.5, 1e-12);
    EXPECT_NEAR(law->force({0, -1.0, load}, nullptr, p.data()), 0.5, 1e-12);
  }
  EXPECT_DOUBLE_EQ(law->force({0, 1.0, 0.0}, nullptr, p.data()), 0.0);
}

// Park et al. 2011, Table VII (mLA left): 4.316e-3 N m s/rad.
TEST(Viscous, GivesTheTorqueOfTableSeven) {
  const auto law = law_named("viscous");
  const Values p = values_of(*law, {{"damping", 4.316e-3}});
  EXPECT_DOUBLE_EQ(law->force({0, 100.0, 0}, nullptr, p.data()), -0.4316);
}

}  // namespace
}  // namespace plumbline::effects
