#include "controllers/blocks/rate_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "simulator/sensing/differentiation.h"

namespace plumbline::controllers {
namespace {

constexpr double period = 1e-3;

TEST(RateFilter, PlainDifferenceByHand) {
  RateFilter filter({2, 1, 0.0}, 0.5);
  EXPECT_EQ(filter.rate(3.0), 0.0);
  EXPECT_DOUBLE_EQ(filter.rate(4.0), 2.0);
  EXPECT_DOUBLE_EQ(filter.rate(3.5), -1.0);
  filter.reset();
  EXPECT_EQ(filter.rate(-7.0), 0.0);
}

TEST(RateFilter, RampComesOutExact) {
  for (const RateFilterOptions options :
       {RateFilterOptions{2, 1}, {5, 1}, {32, 1}, {3, 2}, {9, 2}, {32, 2}}) {
    RateFilter filter(options, period);
    for (int k = 0; k < 100; ++k) {
      const double rate = filter.rate(12.0 - 3.0 * k * period);
      if (k + 1 >= options.samples) {
        ASSERT_NEAR(rate, -3.0, 1e-10) << options.samples << ", " << options.order;
      }
    }
  }
}

// x = t^2: the parabola sees 2 t, the line the slope in the middle of its window, (N - 1)/2 samples ago.
TEST(RateFilter, ParabolaIsNotLate) {
  RateFilter line({9, 1}, period);
  RateFilter parabola({9, 2}, period);
  for (int k = 0; k < 50; ++k) {
    const double t = k * period;
    const double of_line = line.rate(t * t);
    const double of_parabola = parabola.rate(t * t);
    if (k < 8) continue;
    ASSERT_NEAR(of_line, 2.0 * (t - 4 * period), 1e-12);
    ASSERT_NEAR(of_parabola, 2.0 * t, 1e-12);
  }
}

// Counts are at most half a count wrong. With u the distance from the window's middle the slope is then at
// most sum|u| / sum u^2 of that wrong, each sample: for N = 10, 25 / 82.5.
TEST(RateFilter, RampOfCountsIsExactWithinQuantisation) {
  const double q = 6.283185307179586 / 2048;
  RateFilter filter({10, 1}, period);
  double worst = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double rate = filter.rate(q * std::round(0.7 * k * period / q));
    if (k >= 9) worst = std::max(worst, std::abs(rate - 0.7));
  }
  const double bound = 0.5 * q * (25.0 / 82.5) / period;
  EXPECT_LE(worst, bound);
  EXPECT_GT(worst, 0.2 * bound);  // the counts were coarse enough to matter
}

// The simulator's own causal estimate comes from a QR of the fit's matrix.
TEST(RateFilter, AgreesWithTheGeneralFit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  for (const RateFilterOptions options : {RateFilterOptions{2, 1}, {6, 1}, {3, 2}, {9, 2}, {12, 2}}) {
    RateFilter filter(options, period);
    sensing::RunningDifferentiator general({sensing::Evaluation::end, options.order, options.samples},
                                           period);
    for (int k = 0; k < 40; ++k) {
      const double x = position(random);
      ASSERT_NEAR(filter.rate(x), general.update(x), 1e-9) << options.samples << ", " << options.order;
    }
  }
}

// A slope that steps from 0 to 2 and stays: v = 2 (1 - exp(-t / tau)).
TEST(RateFilter, LowPassHasItsTimeConstant) {
  RateFilter filter({2, 1, 0.004}, period);
  for (int k = 0; k < 40; ++k) {
    ASSERT_NEAR(filter.rate(2.0 * k * period), 2.0 * (1.0 - std::exp(-k * period / 0.004)), 1e-12);
  }
}

TEST(RateFilter, RefusesImpossibleOptions) {
  EXPECT_THROW(RateFilter({2, 0}, period), std::invalid_argument);
  EXPECT_THROW(RateFilter({9, 3}, period), std::invalid_argument);
  EXPECT_THROW(RateFilter({1, 1}, period), std::invalid_argument);
  EXPECT_THROW(RateFilter({2, 2}, period), std::invalid_argument);
  EXPECT_THROW(RateFilter({33, 1}, period), std::invalid_argument);
  EXPECT_THROW(RateFilter({2, 1, -1.0}, period), std::invalid_argument);
  EXPECT_THROW(RateFilter({2, 1, std::nan("")}, period), std::invalid_argument);
  EXPECT_THROW(RateFilter({2, 1}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::controllers
