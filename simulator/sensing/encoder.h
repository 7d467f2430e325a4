// What an encoder and a sampled clock make of a true position.
#pragma once

#include <cstdint>
#include <random>

namespace plumbline::sensing {

/// An incremental encoder on a shaft (or scale) that moves `gear` times as far as the measured coordinate:
///   counts = nearest integer of gear * (position + offset) / step
///   position = counts * step / gear - offset
/// Rounding is to the nearest count (halves away from zero), not down: the error is then spread evenly over
/// plus and minus half a resolution, has no mean and a standard deviation of resolution/sqrt(12). A counter
/// that rounds down differs from this by half a count, which is part of `offset`.
/// Source: Park et al., section Sensors (counts per revolution times gear ratio); B. Widrow, I. Kollar,
/// Quantization Noise, Cambridge University Press 2008, section 1.1 (resolution/sqrt(12)).
struct Encoder {
  double step = 0.0;    ///< position per count at the encoder, rad or m; > 0
  double gear = 1.0;    ///< encoder motion per motion of the measured coordinate; not 0, negative: reversed
  double offset = 0.0;  ///< measured coordinate at which the counter would read zero, negated; rad or m

  /// Throws std::invalid_argument naming the member, its value and the allowed range.
  void validate() const;

  /// |step / gear|: motion of the measured coordinate for one count, rad or m.
  double resolution() const;

  /// Throws std::domain_error when the position is not finite or its count does not fit 63 bits.
  std::int64_t counts(double position) const;
  double position(std::int64_t counts) const;
  /// position(counts(p)): what a program on the robot sees.
  double reading(double true_position) const;
};

/// Throws std::invalid_argument when counts_per_turn is not positive or gear is 0.
Encoder rotary_encoder(double counts_per_turn, double gear = 1.0, double offset = 0.0);

/// position plus a draw from a normal distribution; the caller owns the generator, so that a run can be
/// repeated from its seed. `standard_deviation` 0 draws nothing and leaves the generator as it is.
double with_noise(double position, double standard_deviation, std::mt19937_64& generator);

/// Samples at start + k period, k = 0, 1, ..., held until the next one. Times come from k by one
/// multiplication, so that they do not drift.
class SampleClock {
 public:
  /// Throws std::invalid_argument when period is not positive or start not finite.
  explicit SampleClock(double period, double start = 0.0);

  double period() const { return period_; }
  double time(std::int64_t sample) const;
  /// The sample held at time t; negative before start. A t within 1e-6 of a period before a sample counts as
  /// that sample, so that a rounding error does not hold the value of the one before.
  std::int64_t held_sample(double t) const;

 private:
  double period_, start_;
};

}  // namespace plumbline::sensing
