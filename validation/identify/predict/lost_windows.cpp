#include "validation/identify/predict/lost_windows.h"

#include <algorithm>
#include <stdexcept>

namespace plumbline::validation {
namespace {

/// Why it cannot be integrated from the measurements; empty where it can.
std::string why_lost(PredictorPool& pool, int window) {
  std::string reason;
  pool.with(window, {}, {}, [&](Predictor& predictor) {
    const Window& one = pool.data().windows[static_cast<std::size_t>(window)];
    try {
      if (!predictor.residual(one, predictor.search_start(one)).allFinite()) {
        reason = "the prediction is not finite";
      }
    } catch (const std::runtime_error& error) {
      reason = error.what();
    }
  });
  return reason;
}

LostWindow described(const Data& data, std::size_t window, const std::string& reason) {
  const Window& one = data.windows[window];
  const Trial& trial = data.trials[static_cast<std::size_t>(one.trial)];
  return {trial.name, trial.time[one.first], trial.time[one.first + one.count - 1], reason};
}

}  // namespace

Data without_lost(const model::Model& model, const Data& data, std::vector<LostWindow>& lost) {
  PredictorPool pool(model, data);
  std::vector<std::string> reasons(data.windows.size());
  parallel_for(static_cast<int>(data.windows.size()), data.threads,
               [&](int w) { reasons[static_cast<std::size_t>(w)] = why_lost(pool, w); });
  Data kept = data;
  kept.windows.clear();
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    if (reasons[w].empty()) {
      kept.windows.push_back(data.windows[w]);
    } else {
      lost.push_back(described(data, w, reasons[w]));
    }
  }
  for (const Role role : {Role::train, Role::held_out}) {
    if (data.has(role) && !kept.has(role)) {
      const auto first = std::find_if(reasons.begin(), reasons.end(),
                                      [](const std::string& reason) { return !reason.empty(); });
      const LostWindow one = described(data, static_cast<std::size_t>(first - reasons.begin()), *first);
      throw std::runtime_error(one.trial + ": no window can be integrated; the one from " +
                               std::to_string(one.from) + " s: " + one.reason);
    }
  }
  return kept;
}

}  // namespace plumbline::validation
