#include "validation/identify/twin/excitation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace plumbline::validation {
namespace {

constexpr double kPi = 3.14159265358979323846;

Eigen::VectorXd sampled(const Excitation& shape, double period, Eigen::Index count) {
  Eigen::VectorXd command = Eigen::VectorXd::Zero(count);
  shape.add_to(command, {period, count});
  return command;
}

TEST(SteppedChirp, FrequenciesAndAmplitudesAreGeometric) {
  const SteppedChirp chirp({0.5, 50, 17, 0.15, 2.4, false});
  EXPECT_NEAR(chirp.frequency(0), 0.5, 1e-12);
  EXPECT_NEAR(chirp.frequency(8), 5.0, 1e-12);  // the middle of 0.5 and 50
  EXPECT_NEAR(chirp.frequency(16), 50.0, 1e-10);
  EXPECT_NEAR(chirp.amplitude(8), 0.6, 1e-12);  // the middle of 0.15 and 2.4
  EXPECT_NEAR(chirp.amplitude(16), 2.4, 1e-12);
  const SteppedChirp linear({0.5, 50, 17, 0.0, 2.0, true});
  EXPECT_NEAR(linear.amplitude(4), 0.5, 1e-12);
}

// With whole periods in every step a sine's mean square is half its amplitude's square, and the phase is
// back at zero at each boundary.
TEST(SteppedChirp, EachStepHasItsShareItsFrequencyAndAmplitude) {
  const SteppedChirp chirp({1, 4, 3, 1.0, 4.0, false});
  const double period = 1e-3;
  const Eigen::VectorXd u = sampled(chirp, period, 6000);  // 2 s each: 2, 4 and 8 whole periods
  for (int step = 0; step < 3; ++step) {
    const double amplitude = std::pow(2.0, step), frequency = std::pow(2.0, step);
    const Eigen::VectorXd part = u.segment(2000 * step, 2000);
    EXPECT_NEAR(part.squaredNorm() / 2000, 0.5 * amplitude * amplitude, 1e-9);
    for (Eigen::Index k = 0; k < 2000; k += 37) {
      const double t = static_cast<double>(k) * period;
      ASSERT_NEAR(part[k], amplitude * std::sin(2 * kPi * frequency * t), 1e-9);
    }
  }
}

// Steps that end in the middle of a period: with constant amplitude, no sample may jump by more than the
// steepest slope allows.
TEST(SteppedChirp, PhaseIsContinuous) {
  const SteppedChirp chirp({0.7, 23, 11, 1.0, 1.0, false});
  const double period = 1e-4;
  const Eigen::VectorXd u = sampled(chirp, period, 31234);
  const double steepest = 2 * kPi * 23 * period;
  double largest = 0;
  for (Eigen::Index k = 1; k < u.size(); ++k) {
    largest = std::max(largest, std::abs(u[k] - u[k - 1]));
  }
  EXPECT_LE(largest, steepest * (1 + 1e-9));
  EXPECT_NEAR(u.cwiseAbs().maxCoeff(), 1.0, 1e-3);
}

TEST(Multisine, IsTheSumOfItsSines) {
  const Multisine shape({2, 5}, {3, 0.5}, {kPi / 2, 0});
  const Eigen::VectorXd u = sampled(shape, 0.01, 100);
  EXPECT_NEAR(u[0], 3, 1e-12);
  EXPECT_NEAR(u[5], 3 * std::cos(2 * kPi * 2 * 0.05) + 0.5, 1e-12);  // 5 Hz is at its crest
  // Parseval over one second.
  EXPECT_NEAR(u.squaredNorm() / 100, 0.5 * (9 + 0.25), 1e-9);
}

TEST(Steps, HoldTheirLevelsFromTheirTimes) {
  const Eigen::VectorXd u = sampled(Steps({0.1, 0.3}, {2, -1}), 0.1, 5);
  EXPECT_EQ(u, (Eigen::VectorXd(5) << 0, 2, 2, -1, -1).finished());
}

TEST(Pulses, LastTheirWidth) {
  const Eigen::VectorXd u = sampled(Pulses({0.1, 0.6}, 0.2, 3), 0.1, 8);
  EXPECT_EQ(u, (Eigen::VectorXd(8) << 0, 3, 3, 0, 0, 0, 3, 3).finished());
}

TEST(Ramp, ReachesItsEndAtTheLastSample) {
  const Eigen::VectorXd u = sampled(Ramp(1, 3), 0.1, 5);
  EXPECT_TRUE(u.isApprox((Eigen::VectorXd(5) << 1, 1.5, 2, 2.5, 3).finished()));
}

TEST(Sum, AddsAllShapes) {
  Excitations shapes;
  shapes.push_back(std::make_unique<Constant>(10));
  shapes.push_back(std::make_unique<Steps>(std::vector<double>{0.2}, std::vector<double>{1}));
  EXPECT_EQ(sampled_sum(shapes, {0.1, 4}), (Eigen::VectorXd(4) << 10, 10, 11, 11).finished());
}

// A first-order autoregressive process has the correlation a^k at lag k (Box and Jenkins, section 3.2.3).
TEST(FilteredNoise, HasItsDeviationAndCorrelation) {
  const double period = 1e-3, corner = 20;
  const Eigen::Index n = 400000;
  const Eigen::VectorXd u = sampled(FilteredNoise(0.5, corner, 4), period, n);
  const double variance = u.squaredNorm() / static_cast<double>(n);
  EXPECT_NEAR(u.mean(), 0, 0.02);
  EXPECT_NEAR(variance, 0.25, 0.01);
  for (const Eigen::Index lag : {1, 5, 20}) {
    const double correlation = u.head(n - lag).dot(u.tail(n - lag)) / (static_cast<double>(n) * variance);
    EXPECT_NEAR(correlation, std::exp(-2 * kPi * corner * period * static_cast<double>(lag)), 0.02);
  }
  EXPECT_EQ(u.head(50), sampled(FilteredNoise(0.5, corner, 4), period, 50));
  EXPECT_NE(u.head(50), sampled(FilteredNoise(0.5, corner, 5), period, 50));
}

TEST(Excitation, RefusesImpossibleShapes) {
  EXPECT_THROW(SteppedChirp({0, 1, 3, 1, 1, false}), std::invalid_argument);
  EXPECT_THROW(SteppedChirp({1, 2, 1, 1, 1, false}), std::invalid_argument);
  EXPECT_THROW(SteppedChirp({1, 2, 3, 0, 1, false}), std::invalid_argument);
  EXPECT_THROW(Multisine({1, 2}, {1}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(Multisine({}, {}, {}), std::invalid_argument);
  EXPECT_THROW(Multisine({-1}, {1}, {0}), std::invalid_argument);
  EXPECT_THROW(Steps({0.2, 0.1}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(Steps({0.1}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(Pulses({0.1}, 0, 1), std::invalid_argument);
  EXPECT_THROW(Pulses({0.1, 0.2}, 0.15, 1), std::invalid_argument);
  EXPECT_THROW(FilteredNoise(0, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::validation
