// Touchdown and lift-off from the records of contact switches.
#include <algorithm>
#include <cmath>

#include "validation/identify/trial/trial.h"

namespace plumbline::validation {
namespace {

/// First samples of each run of equal values but the first.
std::vector<Eigen::Index> changes_of(const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> changes;
  for (Eigen::Index k = 1; k < values.size(); ++k) {
    if (values[k] != values[k - 1]) {
      changes.push_back(k);
    }
  }
  return changes;
}

/// The record with each run of `value` that is shorter than `fewest` samples turned over; runs at the
/// record's ends may be longer than it shows and stay.
Eigen::VectorXd without_short(const Eigen::VectorXd& values, double value, Eigen::Index fewest) {
  Eigen::VectorXd smooth = values;
  const std::vector<Eigen::Index> changes = changes_of(values);
  for (std::size_t i = 0; i + 1 < changes.size(); ++i) {
    const Eigen::Index length = changes[i + 1] - changes[i];
    if (values[changes[i]] == value && length < fewest) {
      smooth.segment(changes[i], length).setConstant(1.0 - value);
    }
  }
  return smooth;
}

}  // namespace

double timing_floor(const Trial& trial) { return trial.period / std::sqrt(12.0); }

double timing_floor(const Trial& trial, int record) {
  return std::hypot(timing_floor(trial),
                    trial.switches[static_cast<std::size_t>(record)].lateness_uncertainty);
}

std::vector<ContactEvent> contact_events(const Trial& trial) {
  std::vector<ContactEvent> events;
  for (std::size_t r = 0; r < trial.switches.size(); ++r) {
    const SwitchRecord& record = trial.switches[r];
    const auto fewest = static_cast<Eigen::Index>(std::lround(record.bounce / trial.period));
    // Openings first: a foot that lands and bounces has landed when it first touched.
    const Eigen::VectorXd landed = without_short(record.values, 0.0, fewest);
    const Eigen::VectorXd values = without_short(landed, 1.0, fewest);
    for (const Eigen::Index k : changes_of(values)) {
      const bool touchdown = values[k] > values[k - 1];
      const double late = touchdown ? record.closes_late : record.opens_late;
      const auto samples = static_cast<Eigen::Index>(std::lround(late / trial.period));
      events.push_back({trial.time[k] - 0.5 * trial.period - late, std::max<Eigen::Index>(1, k - samples),
                        static_cast<int>(r), touchdown});
    }
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const ContactEvent& a, const ContactEvent& b) { return a.sample < b.sample; });
  return events;
}

std::vector<Stretch> stretches_of(const Trial& trial) {
  return trial.stretches.empty() ? std::vector<Stretch>{{0, trial.samples()}} : trial.stretches;
}

std::vector<Flight> flights_of(const Trial& trial) {
  std::vector<Flight> flights;
  if (trial.switches.empty()) {
    return flights;
  }
  std::vector<bool> down;
  for (const SwitchRecord& record : trial.switches) {
    down.push_back(record.values[0] > 0.0);
  }
  const auto in_flight = [&down] { return std::find(down.begin(), down.end(), true) == down.end(); };
  const Eigen::Index last = trial.samples() - 1;
  const Flight open{trial.time[0], trial.time[last], 0, last, -1, false, false};
  if (in_flight()) {
    flights.push_back(open);
  }
  for (const ContactEvent& event : trial.contact_events) {
    const bool flew = in_flight();
    down[static_cast<std::size_t>(event.record)] = event.touchdown;
    if (flew && event.touchdown) {
      Flight& flight = flights.back();
      flight.touchdown = event.time;
      flight.end = event.sample;
      flight.record = event.record;
      flight.ends = true;
    } else if (!flew && in_flight()) {
      flights.push_back(open);
      flights.back().lift_off = event.time;
      flights.back().first = event.sample;
      flights.back().begins = true;
    }
  }
  return flights;
}

std::vector<Stance> stances_of(const Trial& trial) {
  const std::vector<Flight> flights = flights_of(trial);
  std::vector<Stance> stances;
  for (std::size_t i = 0; i + 1 < flights.size(); ++i) {
    stances.push_back({flights[i].end, flights[i + 1].first});
  }
  return stances;
}

std::optional<Flight> flight_at(const Trial& trial, Eigen::Index sample) {
  for (const Flight& flight : flights_of(trial)) {
    if (flight.begins && flight.ends && flight.first <= sample && sample < flight.end) {
      return flight;
    }
  }
  return std::nullopt;
}

}  // namespace plumbline::validation
