// Where a trial is cut into windows.
#include <algorithm>
#include <cmath>
#include <string>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::validation {
namespace {

/// Shortest window, samples.
constexpr Eigen::Index kShortest = 8;

Eigen::Index sample_at(const Trial& trial, double time) {
  const double* begin = trial.time.data();
  return std::lower_bound(begin, begin + trial.samples(), time) - begin;
}

/// Where windows end in a flight: a little after lift-off and a little before touchdown; in the middle of a
/// flight that is too short for a window of its own.
void cut_flight(const Trial& trial, const Flight& flight, std::vector<Eigen::Index>& cuts) {
  const auto tail = static_cast<Eigen::Index>(std::lround(kTail / trial.period));
  const auto lead = static_cast<Eigen::Index>(std::lround(kLead / trial.period));
  const Eigen::Index samples = flight.end - flight.first;
  if (samples >= tail + lead + kShortest) {
    cuts.push_back(flight.first + tail);
    cuts.push_back(flight.end - lead);
  } else if (samples >= 2 * kShortest) {
    cuts.push_back(flight.first + samples / 2);
  }
}

/// No window begins at an impact: it begins in the flight before, where its initial state is well known, and
/// ends in the flight behind, so that it holds the instants of the contact.
void cut_at_contact(const Trial& trial, std::vector<Eigen::Index>& cuts) {
  for (const Flight& flight : flights_of(trial)) {
    if (flight.begins || flight.ends) {
      cut_flight(trial, flight, cuts);
    }
  }
}

/// Samples at which windows may not continue: trial start, events, contact, gaps, end.
std::vector<Eigen::Index> cut_points(const Trial& trial) {
  std::vector<Eigen::Index> cuts{0};
  for (const double event : trial.events) {
    const Eigen::Index k = sample_at(trial, event);
    if (k > cuts.back() && k < trial.samples()) {
      cuts.push_back(k);
    }
  }
  if (!trial.switches.empty()) {
    cut_at_contact(trial, cuts);
  }
  for (const Stretch& stretch : trial.stretches) {
    cuts.push_back(stretch.first);
    cuts.push_back(stretch.end);
  }
  cuts.push_back(trial.samples());
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

/// Is the sample in a stretch of the recording that may be used?
bool is_used(const Trial& trial, Eigen::Index sample) {
  const std::vector<Stretch> stretches = stretches_of(trial);
  return std::any_of(stretches.begin(), stretches.end(),
                     [&](const Stretch& stretch) { return stretch.first <= sample && sample < stretch.end; });
}

void find_events(const Trial& trial, Window& window) {
  for (std::size_t e = 0; e < trial.contact_events.size(); ++e) {
    const Eigen::Index k = trial.contact_events[e].sample;
    if (k > window.first && k < window.first + window.count) {
      window.events.push_back(static_cast<int>(e));
    }
  }
}

/// Length of a window in samples. Compared before it is converted: any length may have been asked for.
Eigen::Index window_samples(const Trial& trial, double seconds) {
  const double length = std::round(seconds / trial.period);
  if (!(length <= static_cast<double>(trial.samples()))) {
    throw InputError({trial.file, 0, "data"}, std::to_string(trial.samples()) + " samples",
                     "at least one window of " + number_text(length) + " samples (--window sets its length)");
  }
  if (length < static_cast<double>(kShortest)) {
    throw InputError({trial.file, 0, "data"}, "windows of " + number_text(length) + " samples",
                     "windows of " + std::to_string(kShortest) + " or more (--window sets their length)");
  }
  return static_cast<Eigen::Index>(length);
}

bool on_the_ground(const Trial& trial, const Window& window) {
  return std::any_of(trial.switches.begin(), trial.switches.end(), [&](const SwitchRecord& record) {
    return record.values.segment(window.first, window.count).maxCoeff() > 0.0;
  });
}

/// A start that no sensor shows is known in flight only: windows of such a trial begin in one.
void keep_those_from_flight(const Trial& trial, std::vector<Window>& windows, std::ptrdiff_t begin) {
  const auto from_flight = [&](const Window& window) { return flight_at(trial, window.first).has_value(); };
  const auto end = std::stable_partition(windows.begin() + begin, windows.end(), from_flight);
  if (end == windows.begin() + begin) {
    throw InputError({trial.file, 0, "start"}, "no flight in the recording",
                     "one between a lift-off and a touchdown: only there the start of a window is known");
  }
  windows.erase(end, windows.end());
}

/// Samples from k to the nearest one at which a contact switch changes; the trial's length where none does.
Eigen::Index distance_to_contact(const Trial& trial, Eigen::Index k) {
  Eigen::Index nearest = trial.samples();
  for (const SwitchRecord& record : trial.switches) {
    for (Eigen::Index i = 1; i < record.values.size(); ++i) {
      if (record.values[i] != record.values[i - 1]) {
        nearest = std::min(nearest, std::abs(i - k));
      }
    }
  }
  return nearest;
}

/// Where to cut a window in two.
Eigen::Index calm_middle(const Window& window, const Trial& trial) {
  constexpr Eigen::Index kReach = 10;  // a tenth of the window to either side
  const Eigen::Index middle = window.first + window.count / 2;
  Eigen::Index best = middle;
  for (Eigen::Index d = 0; d <= window.count / kReach; ++d) {
    for (const Eigen::Index k : {middle - d, middle + d}) {
      best = distance_to_contact(trial, k) > distance_to_contact(trial, best) ? k : best;
    }
  }
  return best;
}

void add_segments(const Window& window, const Trial& trial, double samples, std::vector<Window>& segments) {
  constexpr double kLongest = 1.5;  // times the length asked for
  const Eigen::Index cut = calm_middle(window, trial) - window.first;
  if (static_cast<double>(window.count) <= kLongest * samples ||
      std::min(cut, window.count - cut) < kShortest) {
    segments.push_back(window);
    find_events(trial, segments.back());
    return;
  }
  add_segments({window.trial, window.first, cut, {}, window.continues}, trial, samples, segments);
  add_segments({window.trial, window.first + cut, window.count - cut, {}, true}, trial, samples, segments);
}

}  // namespace

std::vector<Window> segments_of(const Window& window, const Trial& trial, double length) {
  Window whole = window;
  whole.events.clear();
  std::vector<Window> segments;
  add_segments(whole, trial, length / trial.period, segments);
  if (!trial.start.empty()) {
    segments.resize(1);
  }
  return segments;
}

std::vector<Window> cut_windows(const std::vector<Trial>& trials, const PredictOptions& options) {
  std::vector<Window> windows;
  for (std::size_t t = 0; t < trials.size(); ++t) {
    const Trial& trial = trials[t];
    const Eigen::Index length = window_samples(trial, options.window);
    const auto begin = static_cast<std::ptrdiff_t>(windows.size());
    const std::vector<Eigen::Index> cuts = cut_points(trial);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      const Eigen::Index span = cuts[c + 1] - cuts[c];
      const Eigen::Index parts = std::max<Eigen::Index>(1, (span + length / 2) / length);
      if (span < kShortest || !is_used(trial, cuts[c])) {
        continue;
      }
      for (Eigen::Index p = 0; p < parts; ++p) {
        const Eigen::Index first = cuts[c] + span * p / parts;
        windows.push_back({static_cast<int>(t), first, cuts[c] + span * (p + 1) / parts - first, {}});
        find_events(trial, windows.back());
      }
    }
    if (!trial.start.empty()) {
      keep_those_from_flight(trial, windows, begin);
    }
    // Stance first, then flight: whoever takes every second window then takes some of both.
    std::stable_partition(windows.begin() + begin, windows.end(),
                          [&](const Window& window) { return on_the_ground(trial, window); });
  }
  return windows;
}

Window beginning_of(const Window& window, const Trial& trial, double share) {
  Window part = window;
  part.count = std::max<Eigen::Index>(2, std::lround(share * static_cast<double>(window.count)));
  const auto is_behind = [&](int e) {
    return trial.contact_events[static_cast<std::size_t>(e)].sample >= part.first + part.count;
  };
  part.events.erase(std::remove_if(part.events.begin(), part.events.end(), is_behind), part.events.end());
  return part;
}

}  // namespace plumbline::validation
