// Touchdown and lift-off from the records of contact switches.
#include <algorithm>
#include <cmath>

#include "validation/trial/trial.h"

namespace plumbline::validation {
namespace {

/// First samples of each run of equal values.
std::vector<Eigen::Index> changes_of(const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> changes;
  for (Eigen::Index k = 1; k < values.size(); ++k) {
    if (values[k] != values[k - 1]) {
      changes.push_back(k);
    }
  }
  return changes;
}

/// Without pairs of changes that follow each other within `shortest` samples.
std::vector<Eigen::Index> without_bounces(const std::vector<Eigen::Index>& changes, Eigen::Index shortest) {
  std::vector<Eigen::Index> kept;
  for (const Eigen::Index k : changes) {
    if (!kept.empty() && k - kept.back() < shortest) {
      kept.pop_back();
    } else {
      kept.push_back(k);
    }
  }
  return kept;
}

}  // namespace

double timing_floor(const Trial& trial) { return trial.period / std::sqrt(12.0); }

std::vector<ContactEvent> contact_events(const Trial& trial, double shortest) {
  const auto fewest = static_cast<Eigen::Index>(std::lround(shortest / trial.period));
  std::vector<ContactEvent> events;
  for (std::size_t r = 0; r < trial.switches.size(); ++r) {
    const Eigen::VectorXd& values = trial.switches[r].values;
    for (const Eigen::Index k : without_bounces(changes_of(values), fewest)) {
      events.push_back(
          {trial.time[k] - 0.5 * trial.period, k, static_cast<int>(r), values[k] > values[k - 1]});
    }
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const ContactEvent& a, const ContactEvent& b) { return a.sample < b.sample; });
  return events;
}

}  // namespace plumbline::validation
