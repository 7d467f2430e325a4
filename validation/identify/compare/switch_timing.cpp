#include "validation/identify/compare/switch_timing.h"

#include <algorithm>
#include <cmath>

namespace plumbline::validation {
namespace {

constexpr std::size_t kFewest = 3;

/// Residuals of the events that are of one record and one kind, s.
std::vector<double> instants(PredictorPool& pool, const Estimate& estimate, int trial, int record,
                             bool closes) {
  const Data& data = pool.data();
  std::vector<double> found;
  for (const int w : data.all_windows()) {
    const Window& window = data.windows[static_cast<std::size_t>(w)];
    if (window.trial != trial || window.events.empty()) {
      continue;
    }
    const Trial& read = data.trials[static_cast<std::size_t>(trial)];
    pool.with(w, {}, {}, [&](Predictor& predictor) {
      const Eigen::VectorXd r = predictor.residual(window, estimate.x0[static_cast<std::size_t>(w)]);
      const Eigen::Index first = r.size() - static_cast<Eigen::Index>(window.events.size());
      for (std::size_t e = 0; e < window.events.size(); ++e) {
        const ContactEvent& event = read.contact_events[static_cast<std::size_t>(window.events[e])];
        if (event.record == record && event.touchdown == closes) {
          found.push_back(r[first + static_cast<Eigen::Index>(e)] * timing_floor(read, record));
        }
      }
    });
  }
  return found;
}

}  // namespace

bool SwitchTiming::is_steady() const { return std::abs(mean) > 2.0 * std::max(floor, scatter); }

std::vector<SwitchTiming> switch_timing(PredictorPool& pool, const Estimate& estimate) {
  std::vector<SwitchTiming> all;
  const std::vector<Trial>& trials = pool.data().trials;
  for (std::size_t t = 0; t < trials.size(); ++t) {
    for (std::size_t r = 0; r < trials[t].switches.size(); ++r) {
      for (const bool closes : {true, false}) {
        const auto record = static_cast<int>(r);
        const std::vector<double> off = instants(pool, estimate, static_cast<int>(t), record, closes);
        if (off.size() < kFewest) {
          continue;
        }
        const Eigen::Map<const Eigen::VectorXd> values(off.data(), static_cast<Eigen::Index>(off.size()));
        const double mean = values.mean();
        const double square = (values.array() - mean).square().sum() / static_cast<double>(off.size() - 1);
        all.push_back({trials[t].name, trials[t].switches[r].name, closes, off.size(), mean,
                       std::sqrt(square), timing_floor(trials[t], record)});
      }
    }
  }
  return all;
}

}  // namespace plumbline::validation
