#include "validation/api/comparing.h"

#include <algorithm>

#include "validation/predict/lost_windows.h"
#include "validation/predict/zero_errors.h"
#include "validation/report/result_json.h"

namespace plumbline::api {

namespace {

Compared compare_trials(const model::Model& model, const validation::Data& data) {
  Compared compared;
  std::vector<validation::LostWindow> lost;
  const validation::Data kept = validation::without_lost(model, data, lost);
  validation::PredictorPool pool(model, kept);
  const validation::Estimate estimate = validation::estimate_states(pool);
  compared.comparison = validation::compare(model, kept, estimate);
  compared.comparison.phases = validation::phase_errors(pool, {}, estimate);
  compared.comparison.lost = std::move(lost);
  compared.horizons = validation::horizon_errors(pool, {}, estimate);
  compared.predicted = validation::predicted_traces(pool, {}, estimate);
  return compared;
}

template <typename T>
void append(const std::vector<T>& more, std::vector<T>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Those of the trials of role test, which nothing was chosen by, behind the others.
void append_tests(const Compared& tests, Compared& all) {
  validation::Comparison& comparison = all.comparison;
  append(tests.comparison.channels, comparison.channels);
  append(tests.comparison.windows, comparison.windows);
  append(tests.comparison.phases, comparison.phases);
  append(tests.comparison.lost, comparison.lost);
  append(tests.horizons, all.horizons);
  append(tests.predicted, all.predicted);
  std::stable_sort(
      comparison.windows.begin(), comparison.windows.end(),
      [](const validation::WindowError& a, const validation::WindowError& b) { return a.ratio > b.ratio; });
  comparison.scores.test = tests.comparison.scores.test;
}

}  // namespace

Compared compare(const Loaded& loaded) {
  const validation::Data& data = *loaded.data;
  const model::Model model = validation::with_zero_errors(loaded.model, data);
  Compared compared = data.trials.empty() ? Compared() : compare_trials(model, data);
  if (!data.tests.empty()) {
    append_tests(compare_trials(model, data.of_tests()), compared);
  }
  return compared;
}

nlohmann::json to_json(const Compared& compared) {
  nlohmann::json json = validation::to_json(compared.comparison);
  json["horizons"] = validation::to_json(compared.horizons);
  return json;
}

}  // namespace plumbline::api
