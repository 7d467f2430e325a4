#include "simulator/sensing/differentiation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <tuple>

namespace plumbline::sensing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kPeriod = 1e-3;

Eigen::VectorXd sampled(Eigen::Index n, double (*f)(double)) {
  Eigen::VectorXd y(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    y[k] = f(static_cast<double>(k) * kPeriod);
  }
  return y;
}

class AllOptions : public testing::TestWithParam<std::tuple<Evaluation, int, int>> {
 protected:
  DifferentiationOptions options() const {
    return {std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam())};
  }
};

// A polynomial up to the order comes out exact, at every sample, the ends included.
TEST_P(AllOptions, PolynomialsAreExact) {
  const Eigen::Index n = 80;
  for (int power = 0; power <= options().order; ++power) {
    Eigen::VectorXd y(n), slope(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double t = 30 * static_cast<double>(k) * kPeriod - 1.0;
      y[k] = std::pow(t, power);
      slope[k] = power == 0 ? 0.0 : 30 * power * std::pow(t, power - 1);
    }
    EXPECT_LT((differentiate(y, kPeriod, options()) - slope).cwiseAbs().maxCoeff(), 1e-8)
        << "power " << power;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Differentiation, AllOptions,
    testing::Values(std::make_tuple(Evaluation::end, 1, 2), std::make_tuple(Evaluation::end, 1, 8),
                    std::make_tuple(Evaluation::end, 2, 9), std::make_tuple(Evaluation::end, 3, 30),
                    std::make_tuple(Evaluation::centre, 1, 3), std::make_tuple(Evaluation::centre, 2, 11),
                    std::make_tuple(Evaluation::centre, 4, 13), std::make_tuple(Evaluation::centre, 5, 41)));

TEST(Differentiation, TwoSamplesAreThePlainDifference) {
  const Eigen::VectorXd w = velocity_weights({Evaluation::end, 1, 2});
  ASSERT_EQ(w.size(), 2);
  EXPECT_NEAR(w[0], -1.0, 1e-14);
  EXPECT_NEAR(w[1], 1.0, 1e-14);
}

// A. Savitzky, M. J. E. Golay, Smoothing and differentiation of data by simplified least squares procedures,
// Analytical Chemistry 36 (1964) 1627-1639, first derivative, cubic/quartic, 5 points: (1, -8, 0, 8, -1)/12.
TEST(Differentiation, FivePointQuarticIsSavitzkyAndGolays) {
  const Eigen::VectorXd w = velocity_weights({Evaluation::centre, 4, 5});
  const double expected[] = {1.0 / 12, -8.0 / 12, 0.0, 8.0 / 12, -1.0 / 12};
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(w[k], expected[k], 1e-13);
  }
}

// A straight line through N samples of sin(w t) has the slope w cos(w t_mid) A with
//   A = sum_k k sin(k w T) / (w T sum_k k^2), k = -m .. m, m = (N-1)/2;
// Lagrange: sum sin(k x) k = [sin(m x) (m+1) - m sin((m+1) x)] / (1 - cos x), sum k^2 = m (m+1) (2m+1) / 3.
double line_amplitude(int samples, double x) {
  const int m = (samples - 1) / 2;
  const double numerator = ((m + 1) * std::sin(m * x) - m * std::sin((m + 1) * x)) / (1 - std::cos(x));
  return numerator / (x * m * (m + 1) * (2 * m + 1) / 3.0);
}

TEST(Differentiation, SineInTheCentreHasTheAmplitudeOfTheFormulaAndNoDelay) {
  const DifferentiationOptions options{Evaluation::centre, 1, 21};
  const double omega = 2 * kPi * 20;
  const Eigen::VectorXd y = sampled(300, [](double t) { return std::sin(2 * kPi * 20 * t); });
  const Eigen::VectorXd v = differentiate(y, kPeriod, options);
  const double amplitude = line_amplitude(21, omega * kPeriod);
  EXPECT_NEAR(amplitude, 0.8379, 1e-3);  // the case is not trivial
  for (Eigen::Index k = 10; k < 290; ++k) {
    const double t = static_cast<double>(k) * kPeriod;
    ASSERT_NEAR(v[k] / omega, amplitude * std::cos(omega * t), 1e-10);
  }
}

TEST(Differentiation, CausalLineIsLateByHalfItsWindow) {
  const DifferentiationOptions options{Evaluation::end, 1, 21};
  const double omega = 2 * kPi * 20;
  const Eigen::VectorXd y = sampled(300, [](double t) { return std::sin(2 * kPi * 20 * t); });
  const Eigen::VectorXd v = differentiate(y, kPeriod, options);
  for (Eigen::Index k = 20; k < 300; ++k) {
    const double t = (static_cast<double>(k) - 10) * kPeriod;
    ASSERT_NEAR(v[k] / omega, line_amplitude(21, omega * kPeriod) * std::cos(omega * t), 1e-10);
  }
}

// The least-squares parabola through N samples of x^3 misses it by the discrete orthogonal polynomial
// x^3 - (3 N^2 - 7)/20 x (Gram; Hildebrand, Introduction to Numerical Analysis, section 7.13), so the slope
// at the newest sample x = (N-1)/2 is too small by 3 x^2 - (3 N^2 - 7)/20.
TEST(Differentiation, CausalParabolaOnACubeMissesByGramsPolynomial) {
  for (int samples : {4, 9, 12, 25}) {
    const double x = 0.5 * (samples - 1);
    Eigen::VectorXd y(samples);
    for (int k = 0; k < samples; ++k) {
      y[k] = std::pow(k - x, 3);
    }
    const double slope = velocity_weights({Evaluation::end, 2, samples}).dot(y);
    const double miss = 3 * x * x - (3.0 * samples * samples - 7) / 20;
    EXPECT_NEAR(slope, 3 * x * x - miss, 1e-9 * x * x) << samples << " samples";
  }
}

// Variance of the slope of a line through N samples: 12 / (N (N^2 - 1)) (any textbook on regression).
TEST(Differentiation, NoiseGainOfALine) {
  for (int samples : {2, 7, 12}) {
    EXPECT_NEAR(noise_gain({Evaluation::end, 1, samples}, kPeriod),
                std::sqrt(12.0 / (samples * (samples * samples - 1.0))) / kPeriod, 1e-9);
  }
}

// The numbers that the header states for the defaults.
TEST(Differentiation, DocumentedNoiseOfTheDefaults) {
  EXPECT_NEAR(noise_gain(DifferentiationOptions::causal(), kPeriod), 474, 0.5);
  EXPECT_NEAR(noise_gain(DifferentiationOptions::acausal(), kPeriod), 189, 0.5);
  EXPECT_NEAR(noise_gain({Evaluation::end, 1, 2}, kPeriod), 1414, 0.5);
}

TEST(Differentiation, RunningEstimateIsTheCausalOne) {
  const DifferentiationOptions options = DifferentiationOptions::causal();
  const Eigen::VectorXd y = sampled(60, [](double t) { return std::sin(40 * t) + 3 * t; });
  const Eigen::VectorXd v = differentiate(y, kPeriod, options);
  RunningDifferentiator running(options, kPeriod);
  for (int pass = 0; pass < 2; ++pass) {
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const double now = running.update(y[k]);
      if (k >= options.window - 1) {
        ASSERT_NEAR(now, v[k], 1e-10);
      }
    }
    running.reset();
  }
}

TEST(Differentiation, RunningEstimateStartsAtRest) {
  RunningDifferentiator running(DifferentiationOptions::causal(), kPeriod);
  EXPECT_NEAR(running.update(5.0), 0.0, 1e-9);
  EXPECT_NEAR(running.update(5.0), 0.0, 1e-9);
}

TEST(Differentiation, RefusesImpossibleOptions) {
  EXPECT_THROW(velocity_weights({Evaluation::end, 0, 5}), std::invalid_argument);
  EXPECT_THROW(velocity_weights({Evaluation::end, 3, 3}), std::invalid_argument);
  EXPECT_THROW(velocity_weights({Evaluation::centre, 2, 8}), std::invalid_argument);
  EXPECT_THROW(differentiate(Eigen::VectorXd::Zero(12), kPeriod, DifferentiationOptions::acausal()),
               std::invalid_argument);
  EXPECT_THROW(differentiate(Eigen::VectorXd::Zero(50), 0.0, DifferentiationOptions::acausal()),
               std::invalid_argument);
  EXPECT_THROW(RunningDifferentiator(DifferentiationOptions::acausal(), kPeriod), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::sensing
