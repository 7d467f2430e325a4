// Forces made by a known rule must be described by that rule.
#include "validation/identify/diagnose/dependence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace plumbline::validation {
namespace {

/// Ten seconds at 1 kHz: a slow large swing with a fast small one on it, under a load that comes and goes.
ForceSamples motion() {
  const Eigen::Index n = 10000;
  ForceSamples s;
  s.time = Eigen::VectorXd::LinSpaced(n, 0.0, 10.0);
  s.position = 4.0 * (1.3 * s.time.array()).sin() + 0.3 * (17.0 * s.time.array()).sin();
  s.velocity = 5.2 * (1.3 * s.time.array()).cos() + 5.1 * (17.0 * s.time.array()).cos();
  s.load = 20.0 * (0.7 * s.time.array()).sin().max(0.0);
  s.force_unit = "N m";
  return s;
}

/// `force` with a little noise added.
std::string words_for(ForceSamples samples, const Eigen::ArrayXd& force) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.05 * std::sqrt(force.square().mean()) + 1e-6);
  samples.force = force.unaryExpr([&](double f) { return f + noise(random); });
  return in_words(dependences_of(samples));
}

TEST(Dependence, NamesTheHarmonicOfTheMotorsTurn) {
  const ForceSamples s = motion();
  EXPECT_EQ(words_for(s, 0.3 * (12.0 * s.position.array() + 0.4).sin()),
            "repeats 12 times in a turn of the motor");
}

TEST(Dependence, SeesWhatComesWithTheLoadOnly) {
  const ForceSamples s = motion();
  const Eigen::ArrayXd ripple = (40.0 * s.time.array()).sin();
  EXPECT_EQ(words_for(s, 0.02 * s.load.array() * ripple), "is there only under load");
}

TEST(Dependence, SeesGrowthOverTheTrialWithoutASign) {
  const ForceSamples s = motion();
  const Eigen::ArrayXd ripple = (40.0 * s.time.array()).sin();
  EXPECT_EQ(words_for(s, 0.1 * s.time.array() * ripple), "grows over the trial");
  EXPECT_EQ(words_for(s, 0.1 * (10.0 - s.time.array()) * ripple), "fades over the trial");
}

TEST(Dependence, SeesDirectionVelocityAndPosition) {
  const ForceSamples s = motion();
  EXPECT_EQ(words_for(s, s.velocity.array().sign()), "depends on the direction of motion");
  EXPECT_EQ(words_for(s, s.velocity.array().cube()), "depends on the velocity");
  EXPECT_EQ(words_for(s, s.position.array().square()), "depends on the position");
}

TEST(Dependence, SaysNothingOfNoise) {
  ForceSamples s = motion();
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 1.0);
  s.force = s.time.unaryExpr([&](double) { return noise(random); });
  EXPECT_EQ(in_words(dependences_of(s)), "follows none of position, velocity, load, time and motor angle");
}

}  // namespace
}  // namespace plumbline::validation
