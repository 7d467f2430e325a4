#include "controllers/blocks/rate_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumbline::controllers {
namespace {

void validate(const RateFilterOptions& options, double period) {
  if (options.order != 1 && options.order != 2) {
    throw std::invalid_argument("rate_filter: the order must be 1 or 2");
  }
  if (options.samples <= options.order || options.samples > RateFilterOptions::max_samples) {
    throw std::invalid_argument("rate_filter: the samples must be more than the order and at most 32");
  }
  if (!(std::isfinite(options.time_constant) && options.time_constant >= 0.0)) {
    throw std::invalid_argument("rate_filter: the time constant must be 0 (none) or positive");
  }
  if (!(std::isfinite(period) && period > 0.0)) {
    throw std::invalid_argument("rate_filter: the period must be positive");
  }
}

}  // namespace

// With u counted from the middle of the window, 1, u and u^2 - mean(u^2) are orthogonal on it, so that the
// parabola's slope at the newest sample, u = m, is the line's plus 2 m times the quadratic coefficient.
RateFilter::RateFilter(const RateFilterOptions& options, double period) {
  validate(options, period);
  samples_ = static_cast<std::size_t>(options.samples);
  gain_ = options.time_constant > 0.0 ? -std::expm1(-period / options.time_constant) : 1.0;
  const double middle = 0.5 * (options.samples - 1);
  double sum2 = 0.0;
  double sum4 = 0.0;
  for (int j = 0; j < options.samples; ++j) {
    const double u = middle - j;
    sum2 += u * u;
    sum4 += u * u * u * u;
  }
  const double mean2 = sum2 / options.samples;
  for (int j = 0; j < options.samples; ++j) {
    const double u = middle - j;
    double weight = u / sum2;
    if (options.order == 2) weight += 2.0 * middle * (u * u - mean2) / (sum4 - sum2 * mean2);
    weights_[static_cast<std::size_t>(j)] = weight / period;
  }
}

double RateFilter::rate(double position) noexcept {
  if (!started_) positions_.fill(position);
  started_ = true;
  for (std::size_t j = samples_ - 1; j > 0; --j) positions_[j] = positions_[j - 1];
  positions_[0] = position;
  double slope = 0.0;
  // The weights add up to 0: taking the newest away first changes nothing and rounds less.
  for (std::size_t j = 1; j < samples_; ++j) slope += weights_[j] * (positions_[j] - position);
  velocity_ += gain_ * (slope - velocity_);
  return velocity_;
}

void RateFilter::reset() noexcept {
  started_ = false;
  velocity_ = 0.0;
}

}  // namespace plumbline::controllers
