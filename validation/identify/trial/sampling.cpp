#include "validation/identify/trial/sampling.h"

#include <algorithm>
#include <cmath>

#include "simulator/trace/number_text.h"

namespace plumbline::validation {
namespace {

constexpr Eigen::Index kFewestSamples = 20;
constexpr double kUniform = 0.01;
constexpr double kGapPeriods = 5.0;         // longer gaps are not interpolated
constexpr double kMostSamplesOfARow = 100;  // a log with holes that are longer than it
constexpr double kSameTime = 1e-6;          // of a period: rounding of written times

std::string milliseconds(double value) { return number_text(1e3 * value, 4) + " ms"; }

std::vector<double> steps_of(const Eigen::VectorXd& time) {
  std::vector<double> steps;
  for (Eigen::Index k = 1; k < time.size(); ++k) {
    steps.push_back(time[k] - time[k - 1]);
  }
  return steps;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool are_even(const std::vector<double>& steps, double usual) {
  return std::all_of(steps.begin(), steps.end(),
                     [&](double step) { return std::abs(step - usual) <= kUniform * usual; });
}

}  // namespace

Grid::Grid(Eigen::VectorXd time, const LogSampling& sampling, const Place_in_file& where)
    : rows_(std::move(time)) {
  const Eigen::Index n = rows_.size();
  if (n < kFewestSamples) {
    throw InputError(where, std::to_string(n) + " samples",
                     "at least " + std::to_string(kFewestSamples) + " samples");
  }
  const std::vector<double> steps = steps_of(rows_);
  const double usual = median(steps);
  const double duration = rows_[n - 1] - rows_[0];
  longest_gap_ = sampling.longest_gap > 0.0 ? sampling.longest_gap : kGapPeriods * usual;
  if (sampling.even) {
    period_ = duration / static_cast<double>(n - 1);
    samples_ = Eigen::VectorXd::LinSpaced(n, rows_[0], rows_[n - 1]);
    rows_ = samples_;
    remark_ = "The samples are taken as even, every " + milliseconds(period_) + ": only their stamps jitter.";
    return;
  }
  if (sampling.period == 0.0 && are_even(steps, usual)) {
    period_ = duration / static_cast<double>(n - 1);
    samples_ = rows_;
    return;
  }
  rows_are_samples_ = false;
  period_ = sampling.period > 0.0 ? sampling.period : usual;
  for (Eigen::Index k = 1; k < n; ++k) {
    if (rows_[k] - rows_[k - 1] > longest_gap_) {
      gaps_.push_back({rows_[k - 1], rows_[k]});
    }
  }
  const double count = std::floor(duration / period_ + kSameTime) + 1.0;
  if (count > kMostSamplesOfARow * static_cast<double>(n) || count < static_cast<double>(kFewestSamples)) {
    throw InputError(where,
                     "rows every " + milliseconds(usual) + " over " + number_text(duration, 4) +
                         " s for a period of " + milliseconds(period_),
                     "a sample period for at least 20 samples, and gaps that a period can bridge; "
                     "`section` takes a part of the recording");
  }
  const auto [shortest, longest] = std::minmax_element(steps.begin(), steps.end());
  samples_ =
      rows_[0] + period_ * Eigen::ArrayXd::LinSpaced(static_cast<Eigen::Index>(count), 0.0, count - 1.0);
  remark_ = "The samples are not even (steps of " + milliseconds(*shortest) + " to " +
            milliseconds(*longest) + "): resampled every " + milliseconds(period_) +
            ", channels by straight lines, commands held and averaged over each sample.";
  if (!gaps_.empty()) {
    remark_ += " " + std::to_string(gaps_.size()) + (gaps_.size() == 1 ? " gap is" : " gaps are") +
               " longer than " + milliseconds(longest_gap_) + " and no part of the trial.";
  }
}

double Grid::hair() const { return kSameTime * period_; }

Eigen::Index Grid::row_before(double t, Eigen::Index guess) const {
  while (guess + 1 < rows_.size() && rows_[guess + 1] <= t + hair()) {
    ++guess;
  }
  return guess;
}

Eigen::VectorXd Grid::interpolated(const Eigen::VectorXd& rows) const {
  if (rows_are_samples_) {
    return rows;
  }
  Eigen::VectorXd values(samples_.size());
  Eigen::Index row = 0;
  for (Eigen::Index k = 0; k < samples_.size(); ++k) {
    row = row_before(samples_[k], row);
    const Eigen::Index next = std::min(row + 1, rows.size() - 1);
    const double step = rows_[next] - rows_[row];
    const double share = step > 0.0 ? std::clamp((samples_[k] - rows_[row]) / step, 0.0, 1.0) : 0.0;
    values[k] = rows[row] + share * (rows[next] - rows[row]);
  }
  return values;
}

Eigen::VectorXd Grid::held(const Eigen::VectorXd& rows) const {
  if (rows_are_samples_) {
    return rows;
  }
  Eigen::VectorXd values(samples_.size());
  Eigen::Index row = 0;
  for (Eigen::Index k = 0; k < samples_.size(); ++k) {
    row = row_before(samples_[k], row);
    values[k] = rows[row];
  }
  return values;
}

Eigen::VectorXd Grid::held_mean(const Eigen::VectorXd& rows) const {
  if (rows_are_samples_) {
    return rows;
  }
  Eigen::VectorXd values(samples_.size());
  Eigen::Index row = 0;
  for (Eigen::Index k = 0; k < samples_.size(); ++k) {
    row = row_before(samples_[k], row);
    const double end = samples_[k] + period_;
    double at = samples_[k];
    double sum = 0.0;
    for (Eigen::Index r = row; at < end; ++r) {
      const bool is_last = r + 1 >= rows.size();
      const double until = is_last ? end : std::min(end, rows_[r + 1]);
      sum += rows[r] * std::max(0.0, until - at);
      at = std::max(at, until);
      if (is_last) {
        break;
      }
    }
    values[k] = sum / period_;
  }
  return values;
}

bool Grid::fill(Eigen::VectorXd& rows, bool hold, std::vector<Gap>& gaps) const {
  Eigen::Index last = -1;  // row with a number
  for (Eigen::Index k = 0; k <= rows.size(); ++k) {
    const bool at_end = k == rows.size();
    if (!at_end && !std::isfinite(rows[k])) {
      continue;
    }
    if (at_end && last < 0) {
      return false;
    }
    if (k > last + 1) {
      const double from = last < 0 ? rows_[0] - period_ : rows_[last];
      const double to = at_end ? rows_[rows.size() - 1] + period_ : rows_[k];
      for (Eigen::Index i = last + 1; i < k; ++i) {
        if (last < 0) {
          rows[i] = rows[k];
        } else if (at_end || hold) {
          rows[i] = rows[last];
        } else {
          rows[i] = rows[last] + (rows[k] - rows[last]) * (rows_[i] - rows_[last]) / (rows_[k] - rows_[last]);
        }
      }
      if (to - from > longest_gap_ || last < 0 || at_end) {
        gaps.push_back({from, to});
      }
    }
    last = k;
  }
  return true;
}

std::vector<Stretch> Grid::stretches(const std::vector<Gap>& gaps) const {
  std::vector<Stretch> stretches;
  for (Eigen::Index k = 0; k < samples_.size(); ++k) {
    const bool in_gap = std::any_of(gaps.begin(), gaps.end(), [&](const Gap& gap) {
      return gap.from + hair() < samples_[k] && samples_[k] < gap.to - hair();
    });
    if (in_gap) {
      continue;
    }
    // A gap may lie between two samples that are both known.
    const bool behind_gap = k > 0 && std::any_of(gaps.begin(), gaps.end(), [&](const Gap& gap) {
                              return gap.from >= samples_[k - 1] - hair() && gap.to <= samples_[k] + hair();
                            });
    if (stretches.empty() || stretches.back().end != k || behind_gap) {
      stretches.push_back({k, k});
    }
    stretches.back().end = k + 1;
  }
  return stretches;
}

}  // namespace plumbline::validation
