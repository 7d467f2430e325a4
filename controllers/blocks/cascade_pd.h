// Position and velocity loops in cascade, as industrial drives run them. Pure: numbers in, number out.
#pragma once

#include <array>

namespace plumbline::controllers {

/// Constants of a CascadePd.
struct CascadePdGains {
  double position_gain = 0.0;  ///< kp, 1/s
  double velocity_gain = 0.0;  ///< kv, command unit s per position unit
  double command_limit = 0.0;  ///< largest magnitude of the command, command unit; 0: none
  double period = 1e-3;        ///< T, s
  int difference_samples = 1;  ///< n, samples over which the velocity is differenced: 1 or 2
};

/// u = kv (kp (r - y) - v) + d, held within plus and minus the command limit,
/// with the causal difference v = (y_k - y_(k-n)) / (n T); over fewer samples while fewer are known, and v =
/// 0 at the first. r, y in rad or m; u, d in the unit of the motor's command. Source: A. Janot, M. Gautier,
/// M. Brunot, Data set and reference models of EMPS, Nonlinear System Identification Benchmarks 2019, where
/// such a controller drove the measured axis.
class CascadePd {
 public:
  /// Throws std::invalid_argument when a gain is not finite, the limit is negative, the period not positive
  /// or difference_samples neither 1 nor 2.
  explicit CascadePd(const CascadePdGains& gains);

  /// One sample: takes the newest measurement and returns the command to hold until the next.
  double command(double reference, double measured, double disturbance = 0.0) noexcept;

  /// Forgets the measurements before; the next sample counts as the first.
  void reset() noexcept { known_ = 0; }
  /// As reset, with a known measurement one period before the next.
  void reset(double previous_measured) noexcept;
  /// As reset, for a motion that is under way: the next measurement is about `measured`, and those before it
  /// were what this velocity makes of it.
  void reset(double measured, double velocity) noexcept;

 private:
  CascadePdGains gains_;
  std::array<double, 2> previous_{};  // newest first
  int known_ = 0;
};

}  // namespace plumbline::controllers
