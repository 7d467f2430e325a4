// The spectrum against what is known of white noise and sines.
#include "validation/report/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace plumbline::validation {
namespace {

constexpr double kTurn = 6.283185307179586;
constexpr double kPeriod = 1e-3;

std::vector<Span> windows(Eigen::Index count, Eigen::Index length) {
  std::vector<Span> spans;
  for (Eigen::Index w = 0; w < count; ++w) {
    spans.push_back({w * length, length});
  }
  return spans;
}

TEST(Spectrum, WhiteNoiseLiesOnTheFloor) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.02);
  Eigen::VectorXd r(400 * 500);
  for (double& value : r) {
    value = noise(random);
  }
  const Spectrum lines = spectrum(r, windows(400, 500), kPeriod);
  EXPECT_DOUBLE_EQ(lines.frequency_step, 2.0);
  ASSERT_EQ(lines.density.size(), 251);
  const double expected = density_of_floor(0.02, kPeriod);
  // one line of 400 averaged periodograms scatters by about 1/(2 sqrt(400)) = 2.5 %
  for (Eigen::Index k = 2; k < 249; ++k) {
    EXPECT_NEAR(lines.density[k], expected, 0.12 * expected) << k;
  }
}

TEST(Spectrum, HasThePowerOfASine) {
  Eigen::VectorXd r(20 * 500);
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    r[k] = 0.3 * std::sin(kTurn * 40.0 * kPeriod * static_cast<double>(k));
  }
  const Spectrum lines = spectrum(r, windows(20, 500), kPeriod);
  EXPECT_NEAR(lines.density.cwiseAbs2().sum() * lines.frequency_step, 0.5 * 0.3 * 0.3, 1e-3 * 0.045);
  Eigen::Index peak = 0;
  lines.density.maxCoeff(&peak);
  EXPECT_EQ(peak, 20);  // 40 Hz
}

TEST(Spectrum, DoesNotSeeJumpsBetweenWindows) {
  Eigen::VectorXd r(2 * 500);
  r << Eigen::VectorXd::Constant(500, 1.0), Eigen::VectorXd::Constant(500, -1.0);
  const Spectrum lines = spectrum(r, windows(2, 500), kPeriod);
  EXPECT_LT(lines.density.tail(240).maxCoeff(), 1e-9 * lines.density[0]);
}

TEST(Spectrum, CutsWindowsOfAlmostTheSameLengthAndLeavesOutShortOnes) {
  const Eigen::VectorXd r = Eigen::VectorXd::Ones(1200);
  const Spectrum lines = spectrum(r, {{0, 500}, {500, 501}, {1001, 20}}, kPeriod);
  EXPECT_EQ(lines.density.size(), 251);
}

}  // namespace
}  // namespace plumbline::validation
