// Velocity from sampled positions while they come in. Pure: no allocation.
#pragma once

#include <array>
#include <cstddef>

namespace plumbline::controllers {

/// Constants of a RateFilter. The defaults are the plain backward difference.
struct RateFilterOptions {
  static constexpr int max_samples = 32;

  int samples = 2;             ///< N, newest positions that are fitted; order < N <= max_samples
  int order = 1;               ///< degree of the fitted polynomial: 1 (line) or 2 (parabola)
  double time_constant = 0.0;  ///< tau of the low-pass behind it, s; 0: none
};

/// A polynomial is fitted by least squares to the newest N positions; its slope s_k at the newest one passes
/// a first-order low-pass with its input held over each sample:
///   v_k = v_(k-1) + (1 - exp(-T/tau)) (s_k - v_(k-1)),  v = 0 before the first.
/// Polynomials up to the order come out exact once N samples are in (without low-pass). Before that, the
/// position is taken to have been the first one all along, so the first slope is 0.
/// For positions with independent errors of standard deviation e, the line's slope has that of
/// e sqrt(12 / (N (N^2 - 1))) / T and is (N - 1)/2 samples late; the parabola is noisier and not late.
/// The method of causal differentiation that the MABEL paper names in its section Sensors (its reference
/// 27); the paper gives neither order nor N.
class RateFilter {
 public:
  /// Throws std::invalid_argument when an option is outside its range or the period (s) not positive.
  RateFilter(const RateFilterOptions& options, double period);

  /// Takes the newest position and returns the velocity there, in the position's unit per second.
  double rate(double position) noexcept;
  /// Forgets all positions.
  void reset() noexcept;

 private:
  using Window = std::array<double, RateFilterOptions::max_samples>;

  std::size_t samples_;
  double gain_;  // of the low-pass
  Window weights_{};
  Window positions_{};  // newest first
  bool started_ = false;
  double velocity_ = 0.0;
};

}  // namespace plumbline::controllers
