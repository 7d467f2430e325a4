#include "simulator/integrate/step_control.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::integrate {

namespace {
constexpr double kSafety = 0.9;
constexpr double kLeast = 0.15;  // factors of change
constexpr double kMost = 10.0;
}  // namespace

void StepControl::set_stop(double t, double t_stop) {
  stop_ = t_stop;
  stretch_ = t_stop - t;
}

double StepControl::even(double t) const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double to_stop = stop_ - t;
  const double left = to_stop > 8.0 * epsilon * std::abs(stop_) ? to_stop : stretch_;
  return wanted_ >= left ? wanted_ : left / std::ceil(left / wanted_ * (1.0 - 8.0 * epsilon));
}

double StepControl::next(double t, double h, double error) {
  const bool rejected = !(error <= 1.0);  // also when it is not a number
  const double most = rejected ? kSafety : rejected_ ? 1.0 : kMost;
  const double raw = std::isfinite(error) ? kSafety * std::pow(std::max(error, 1e-12), exponent_) : kLeast;
  const double before = wanted_;
  wanted_ = h * std::clamp(raw, kLeast, most);
  // A step much shorter than wanted was cut short by a stop, and says no more than that longer ones will do.
  if (!rejected && !rejected_ && raw >= kMost) wanted_ = std::max(wanted_, before);
  rejected_ = rejected;
  return even(t);
}

}  // namespace plumbline::integrate
