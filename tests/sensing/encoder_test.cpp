#include "simulator/sensing/encoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace plumbline::sensing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

// Park et al., section Sensors: resolutions that the paper prints, in degrees per count.
TEST(Encoder, ResolutionsOfMabelAsPrinted) {
  EXPECT_NEAR(rotary_encoder(2048).resolution() / kDegree, 0.1758, 5e-5);
  EXPECT_NEAR(rotary_encoder(2048, 19.8).resolution() / kDegree, 0.008878, 5e-7);
  EXPECT_NEAR(rotary_encoder(2048, 3).resolution() / kDegree, 0.05859, 5e-6);
  EXPECT_NEAR(rotary_encoder(40000, 7.3987).resolution() / kDegree, 0.001216, 5e-7);
}

TEST(Encoder, WholeTurnsCountExactly) {
  const Encoder encoder = rotary_encoder(2048, 3);
  EXPECT_EQ(encoder.counts(2 * kPi), 6144);
  EXPECT_EQ(encoder.counts(-2 * kPi), -6144);
  EXPECT_NEAR(encoder.position(6144), 2 * kPi, 1e-12);
}

TEST(Encoder, RoundsToTheNearestCount) {
  const Encoder encoder{0.5, 1.0, 0.0};
  EXPECT_EQ(encoder.counts(0.24), 0);
  EXPECT_EQ(encoder.counts(0.26), 1);
  EXPECT_EQ(encoder.counts(-0.24), 0);
  EXPECT_EQ(encoder.counts(-0.26), -1);
  EXPECT_EQ(encoder.counts(0.25), 1);  // halves away from zero
  EXPECT_EQ(encoder.counts(-0.25), -1);
}

TEST(Encoder, OffsetAndReversedGear) {
  const Encoder encoder{0.01, -2.0, 0.3};
  EXPECT_EQ(encoder.counts(0.2), -100);  // -2 (0.2 + 0.3) / 0.01
  EXPECT_NEAR(encoder.position(-100), 0.2, 1e-15);
  EXPECT_EQ(encoder.counts(-0.3), 0);
}

TEST(Encoder, ReadingIsWithinHalfAResolutionAndStable) {
  const Encoder encoder = rotary_encoder(2048, 19.8, 0.123);
  for (int i = -500; i <= 500; ++i) {
    const double truth = 0.001237 * i;
    const double reading = encoder.reading(truth);
    EXPECT_LE(std::abs(reading - truth), 0.5 * encoder.resolution() * (1 + 1e-9));
    EXPECT_EQ(encoder.counts(reading), encoder.counts(truth));
  }
}

// Widrow and Kollar, Quantization Noise, section 1.1: uniform error, mean 0, variance q^2/12, fourth moment
// q^4/80. Positions spread over very many cells.
TEST(Encoder, ErrorHasTheMomentsOfAUniformDistribution) {
  const Encoder encoder{1e-3, 1.0, 0.0};
  const double q = encoder.resolution();
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> anywhere(-10.0, 10.0);
  const int n = 400000;
  double first = 0, second = 0, fourth = 0;
  for (int i = 0; i < n; ++i) {
    const double truth = anywhere(generator);
    const double e = (encoder.reading(truth) - truth) / q;
    first += e / n;
    second += e * e / n;
    fourth += e * e * e * e / n;
  }
  // Five standard deviations of each sample moment.
  EXPECT_NEAR(first, 0.0, 5 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(second, 1.0 / 12, 5 * std::sqrt((1.0 / 80 - 1.0 / 144) / n));
  EXPECT_NEAR(fourth, 1.0 / 80, 5 * std::sqrt((1.0 / 2304) / n));
}

TEST(Encoder, RefusesWhatNoCounterCanHold) {
  const Encoder encoder{1e-6, 1.0, 0.0};
  EXPECT_THROW(encoder.counts(std::numeric_limits<double>::quiet_NaN()), std::domain_error);
  EXPECT_THROW(encoder.counts(std::numeric_limits<double>::infinity()), std::domain_error);
  EXPECT_THROW(encoder.counts(1e14), std::domain_error);
  EXPECT_EQ(encoder.counts(1e9), 1000000000000000);
}

TEST(Encoder, RefusesImpossibleOptions) {
  EXPECT_THROW(rotary_encoder(0), std::invalid_argument);
  EXPECT_THROW(rotary_encoder(-2048), std::invalid_argument);
  EXPECT_THROW(rotary_encoder(2048, 0), std::invalid_argument);
  EXPECT_THROW((Encoder{0.0, 1.0, 0.0}.validate()), std::invalid_argument);
  EXPECT_THROW((Encoder{1.0, 1.0, std::nan("")}.validate()), std::invalid_argument);
}

TEST(Noise, HasTheStatedMeanAndDeviation) {
  std::mt19937_64 generator(7);
  const int n = 200000;
  const double sigma = 0.02;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double e = with_noise(1.0, sigma, generator) - 1.0;
    sum += e;
    squares += e * e;
  }
  EXPECT_NEAR(sum / n, 0.0, 5 * sigma / std::sqrt(n));
  EXPECT_NEAR(squares / n, sigma * sigma, 5 * sigma * sigma * std::sqrt(2.0 / n));
}

TEST(Noise, RepeatsFromItsSeedAndDrawsNothingForZero) {
  std::mt19937_64 a(3), b(3);
  EXPECT_EQ(with_noise(0.5, 0.0, a), 0.5);
  EXPECT_EQ(with_noise(0.5, 0.1, a), with_noise(0.5, 0.1, b));
  EXPECT_THROW(with_noise(0.5, -0.1, a), std::invalid_argument);
}

TEST(SampleClock, HoldsEachSampleUntilTheNext) {
  const SampleClock clock(0.001, 2.0);
  EXPECT_EQ(clock.held_sample(2.0), 0);
  EXPECT_EQ(clock.held_sample(2.0009), 0);
  EXPECT_EQ(clock.held_sample(2.0011), 1);
  EXPECT_LT(clock.held_sample(1.9), 0);
}

TEST(SampleClock, EverySampleTimeBelongsToItsSample) {
  const SampleClock clock(0.001);
  for (std::int64_t k = 0; k < 200000; ++k) {
    ASSERT_EQ(clock.held_sample(clock.time(k)), k);
  }
  // A time summed up step by step is off by rounding, yet means the sample.
  double t = 0;
  for (std::int64_t k = 0; k < 20000; ++k, t += 0.001) {
    ASSERT_EQ(clock.held_sample(t), k);
  }
}

TEST(SampleClock, RefusesABadPeriod) {
  EXPECT_THROW(SampleClock(0.0), std::invalid_argument);
  EXPECT_THROW(SampleClock(-1e-3), std::invalid_argument);
  EXPECT_THROW(SampleClock(1e-3, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::sensing
