#include "validation/identify/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulator/model/kinds.h"
#include "validation/identify/predict/zero_errors.h"

namespace plumbline::validation {
namespace {

std::vector<ChannelError> channel_errors(const model::Model& model, const Data& data,
                                         const Estimate& estimate) {
  std::vector<ChannelError> errors;
  for (std::size_t t = 0; t < data.trials.size(); ++t) {
    const Trial& trial = data.trials[t];
    Eigen::VectorXd sum =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(trial.measured.size() + trial.switches.size()));
    double samples = 0.0;
    std::vector<int> events;
    for (std::size_t w = 0; w < data.windows.size(); ++w) {
      if (data.windows[w].trial == static_cast<int>(t)) {
        sum += estimate.square[w];
        samples += static_cast<double>(data.windows[w].count);
        events.insert(events.end(), data.windows[w].events.begin(), data.windows[w].events.end());
      }
    }
    for (std::size_t c = 0; c < trial.measured.size(); ++c) {
      const model::Sensor sensor = sensor_of(model, trial.measured[c]);
      ChannelError error;
      error.trial = trial.name;
      error.name = sensor.name;
      error.unit = model::reading_unit(model, sensor.name);
      error.role = trial.role;
      error.floor = sensor.floor();
      error.ratio = std::sqrt(sum[static_cast<Eigen::Index>(c)] / std::max(samples, 1.0));
      error.rms = error.ratio * error.floor;
      errors.push_back(error);
    }
    for (std::size_t r = 0; r < trial.switches.size(); ++r) {
      const auto count = std::count_if(events.begin(), events.end(), [&](int e) {
        return trial.contact_events[static_cast<std::size_t>(e)].record == static_cast<int>(r);
      });
      const double square = sum[static_cast<Eigen::Index>(trial.measured.size() + r)];
      ChannelError error{
          trial.name, trial.switches[r].name, "s", trial.role, 0.0, timing_floor(trial, static_cast<int>(r)),
          0.0};
      error.ratio = std::sqrt(square / std::max(static_cast<double>(count), 1.0));
      error.rms = error.ratio * error.floor;
      errors.push_back(error);
    }
  }
  return errors;
}

void sort_worst_first(std::vector<WindowError>& errors) {
  std::stable_sort(errors.begin(), errors.end(),
                   [](const WindowError& a, const WindowError& b) { return a.ratio > b.ratio; });
}

std::vector<WindowError> window_errors(const Data& data, const Estimate& estimate) {
  std::vector<WindowError> errors;
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    const Window& window = data.windows[w];
    const Trial& trial = data.trials[static_cast<std::size_t>(window.trial)];
    const auto channels = static_cast<Eigen::Index>(trial.measured.size());
    const Eigen::VectorXd square = estimate.square[w].head(channels) / static_cast<double>(window.count);
    Eigen::Index worst = 0;
    square.maxCoeff(&worst);
    errors.push_back({trial.name, trial.time[window.first], trial.time[window.first + window.count - 1],
                      std::sqrt(square.mean()), trial.measured[static_cast<std::size_t>(worst)].sensor});
  }
  sort_worst_first(errors);
  return errors;
}

template <typename T>
void append(const std::vector<T>& more, std::vector<T>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

Comparison compare_trials(const model::Model& model, const Data& data, bool with_curves) {
  std::vector<LostWindow> lost;
  const Data kept = without_lost(model, data, lost);
  PredictorPool pool(model, kept);
  const Estimate estimate = estimate_states(pool);
  Comparison comparison = compare(model, kept, estimate);
  comparison.phases = phase_errors(pool, {}, estimate);
  comparison.lost = std::move(lost);
  comparison.switches = switch_timing(pool, estimate);
  if (with_curves) {
    comparison.horizons = horizon_errors(pool, {}, estimate);
    comparison.predicted = predicted_traces(pool, {}, estimate);
  }
  return comparison;
}

/// Those of the trials of role test, which nothing is chosen by, behind the others.
Comparison compare_all(const model::Model& bare, const Data& data, bool with_curves) {
  const model::Model model = with_zero_errors(bare, data);
  Comparison comparison = data.trials.empty() ? Comparison() : compare_trials(model, data, with_curves);
  if (with_curves) {
    comparison.defects = defects(model, data);
  }
  if (data.tests.empty()) {
    return comparison;
  }
  const Comparison tests = compare_trials(model, data.of_tests(), with_curves);
  append(tests.channels, comparison.channels);
  append(tests.windows, comparison.windows);
  append(tests.phases, comparison.phases);
  append(tests.lost, comparison.lost);
  append(tests.switches, comparison.switches);
  append(tests.horizons, comparison.horizons);
  append(tests.predicted, comparison.predicted);
  sort_worst_first(comparison.windows);
  comparison.scores.test = tests.scores.test;
  return comparison;
}

}  // namespace

Comparison compare(const model::Model& model, const Data& data, const Estimate& estimate) {
  Comparison comparison;
  comparison.channels = channel_errors(model, data, estimate);
  comparison.windows = window_errors(data, estimate);
  comparison.scores = estimate.scores;
  return comparison;
}

Comparison compare(const model::Model& model, const Data& data) { return compare_all(model, data, false); }

Comparison compare_with_curves(const model::Model& model, const Data& data) {
  return compare_all(model, data, true);
}

}  // namespace plumbline::validation
