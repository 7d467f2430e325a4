#include "simulator/sensing/encoder.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace plumbline::sensing {
namespace {

constexpr double kTurn = 6.283185307179586476925;
constexpr double kLargestCount = 9.2e18;  // just below 2^63
constexpr double kClockTolerance = 1e-6;  // of a period

[[noreturn]] void refuse(const char* what, double found, const char* expected) {
  std::ostringstream message;
  message << what << ": found " << found << ", expected " << expected;
  throw std::invalid_argument(message.str());
}

}  // namespace

void Encoder::validate() const {
  if (!(std::isfinite(step) && step > 0.0)) {
    refuse("encoder step", step, "a positive number");
  }
  if (!(std::isfinite(gear) && gear != 0.0)) {
    refuse("encoder gear", gear, "a finite number other than 0");
  }
  if (!std::isfinite(offset)) {
    refuse("encoder offset", offset, "a finite number");
  }
}

double Encoder::resolution() const { return std::abs(step / gear); }

std::int64_t Encoder::counts(double position) const {
  const double exact = gear * (position + offset) / step;
  if (!(std::abs(exact) < kLargestCount)) {
    throw std::domain_error("encoder position does not fit its counter");
  }
  return std::llround(exact);
}

double Encoder::position(std::int64_t counts) const {
  return static_cast<double>(counts) * step / gear - offset;
}

double Encoder::reading(double true_position) const { return position(counts(true_position)); }

Encoder rotary_encoder(double counts_per_turn, double gear, double offset) {
  if (!(std::isfinite(counts_per_turn) && counts_per_turn > 0.0)) {
    refuse("counts per turn", counts_per_turn, "a positive number");
  }
  const Encoder encoder{kTurn / counts_per_turn, gear, offset};
  encoder.validate();
  return encoder;
}

double with_noise(double position, double standard_deviation, std::mt19937_64& generator) {
  if (standard_deviation == 0.0) {
    return position;
  }
  if (!(std::isfinite(standard_deviation) && standard_deviation > 0.0)) {
    refuse("standard deviation of noise", standard_deviation, "0 or a positive number");
  }
  return position + std::normal_distribution<double>(0.0, standard_deviation)(generator);
}

SampleClock::SampleClock(double period, double start) : period_(period), start_(start) {
  if (!(std::isfinite(period) && period > 0.0)) {
    refuse("sample period", period, "a positive number of seconds");
  }
  if (!std::isfinite(start)) {
    refuse("clock start", start, "a finite number of seconds");
  }
}

double SampleClock::time(std::int64_t sample) const { return start_ + static_cast<double>(sample) * period_; }

std::int64_t SampleClock::held_sample(double t) const {
  return static_cast<std::int64_t>(std::floor((t - start_) / period_ + kClockTolerance));
}

}  // namespace plumbline::sensing
