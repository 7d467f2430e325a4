#include "simulator/sensing/low_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace plumbline::sensing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kPeriod = 1e-3;

Eigen::VectorXd sine(double frequency, double phase, Eigen::Index samples) {
  Eigen::VectorXd signal(samples);
  for (Eigen::Index k = 0; k < samples; ++k) {
    signal[k] = std::sin(2.0 * kPi * frequency * kPeriod * static_cast<double>(k) + phase);
  }
  return signal;
}

/// Amplitude of the sine and cosine part at a frequency, away from the ends.
double gain_of(double frequency, double cutoff) {
  const Eigen::Index n = 4000;
  const Eigen::Index from = 1000;
  const Eigen::VectorXd out = low_pass(sine(frequency, 0.3, n), kPeriod, cutoff).segment(from, 2000);
  const Eigen::VectorXd in = sine(frequency, 0.3, n).segment(from, 2000);
  const Eigen::VectorXd quadrature = sine(frequency, 0.3 + kPi / 2, n).segment(from, 2000);
  EXPECT_NEAR(out.dot(quadrature) / quadrature.squaredNorm(), 0.0, 1e-6) << "phase at " << frequency;
  return out.dot(in) / in.squaredNorm();
}

// |H|^2 of a digital Butterworth filter (Oppenheim and Schafer, chapter 7, bilinear transformation): 1 / (1 +
// (tan(w/2)/tan(wc/2))^(2 order)); two runs square |H|.
TEST(LowPass, GainOfAButterworthFilterWithoutPhase) {
  EXPECT_NEAR(gain_of(40.0, 40.0), 0.5, 1e-6);
  for (const double frequency : {5.0, 20.0, 37.0, 55.0, 90.0, 210.0}) {
    const double ratio = std::tan(kPi * frequency * kPeriod) / std::tan(kPi * 40.0 * kPeriod);
    EXPECT_NEAR(gain_of(frequency, 40.0), 1.0 / (1.0 + std::pow(ratio, 8)), 1e-6) << frequency;
  }
}

TEST(LowPass, StraightLineStaysAsItIs) {
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(500, 3.0, -40.0);
  const Eigen::VectorXd out = low_pass(line, kPeriod, 25.0);
  EXPECT_LT((out - line).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LowPass, RefusesWhatItCannotDo) {
  const Eigen::VectorXd signal = Eigen::VectorXd::Ones(100);
  EXPECT_THROW(low_pass(signal, kPeriod, 500.0), std::invalid_argument);
  EXPECT_THROW(low_pass(signal, kPeriod, 0.0), std::invalid_argument);
  EXPECT_THROW(low_pass(signal, 0.0, 10.0), std::invalid_argument);
  EXPECT_THROW(low_pass(signal.head(5), kPeriod, 10.0), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::sensing
