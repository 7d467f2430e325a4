#include "validation/identify/predict/reach.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "validation/identify/predict/initial_states.h"
#include "validation/identify/predict/kept_keys.h"
#include "validation/identify/predict/whole_windows.h"

namespace plumbline::validation {
namespace {

constexpr double kFirstSegments = 1.0 / 16.0;  // of PredictOptions::window
constexpr double kShortestSegments = 1.0 / 32.0;

/// States of windows, the squares that they leave (infinite ones where none was found), and whether the
/// search has gone astray there.
struct SettledWindows {
  std::vector<Eigen::VectorXd> x0;
  Eigen::VectorXd raw, astray;
  bool is_astray(int window) const { return astray[window] != 0.0; }
};

Record settle_in_turn(const model::Model& model, const Data& data, std::vector<Eigen::VectorXd> x0,
                      const std::vector<double>& expected, std::size_t most) {
  const std::vector<FreeParameter> as_it_is;
  PredictorPool pool(model, data);
  Point at{{}, std::move(x0)};
  const std::vector<Reduced> reduced =
      InitialStates(pool, as_it_is, {}).settle_in_turn(kRoughly, at, expected, most);
  Eigen::VectorXd raw(static_cast<Eigen::Index>(reduced.size()));
  Eigen::VectorXd astray = raw;
  for (const int w : data.all_windows()) {
    const auto i = static_cast<std::size_t>(w);
    raw[w] = reduced[i].raw_sse;
    astray[w] = is_astray(data, w, reduced, expected) ? 1.0 : 0.0;
  }
  return Record().add(at.x0).add(raw).add(astray);
}

/// All windows of `data` in turn, those with a state from there; no more than show that too many are lost.
SettledWindows settled_in_turn(const model::Model& model, const Data& data,
                               const std::vector<Eigen::VectorXd>& x0,
                               const std::vector<double>& expected = {}, std::size_t most = kAnyNumber) {
  ResultKey key = key_of("settle_in_turn", model, data);
  key.numbers.add(x0).add(static_cast<double>(most)).add(static_cast<double>(expected.size()));
  for (const double one : expected) {
    key.numbers.add(one);
  }
  const Record record = kept(data, key, [&] { return settle_in_turn(model, data, x0, expected, most); });
  RecordReader reader(record);
  SettledWindows settled;
  settled.x0 = reader.vectors();
  settled.raw = reader.vector();
  settled.astray = reader.vector();
  return settled;
}

/// Windows that are followed, and the mean squares of their residuals.
struct Level {
  Followed followed;
  std::vector<double> square;
};

Level empty_level(const Data& data, double length) {
  Level level{{data, {}, length}, {}};
  level.followed.data.windows.clear();
  return level;
}

void add(const Window& window, const Eigen::VectorXd& x0, double square, Level& level) {
  level.followed.data.windows.push_back(window);
  level.followed.x0.push_back(x0);
  level.square.push_back(square);
}

double mean_square(const Data& data, int window, const SettledWindows& settled) {
  return settled.raw[window] / readings(data, window);
}

/// Without those that are far above the others, which a search has lost: more than three times the ninth
/// decile of the root mean squares.
Level trimmed(const Level& level) {
  constexpr double kFar = 9.0;  // of mean squares
  if (level.square.empty()) {
    return level;
  }
  std::vector<double> sorted = level.square;
  const auto decile = sorted.begin() + static_cast<std::ptrdiff_t>(9 * (sorted.size() - 1) / 10);
  std::nth_element(sorted.begin(), decile, sorted.end());
  const double most = kFar * std::max(kFits * kFits, *decile);
  Level kept = empty_level(level.followed.data, level.followed.length);
  for (std::size_t w = 0; w < level.square.size(); ++w) {
    if (level.square[w] <= most) {
      add(level.followed.data.windows[w], level.followed.x0[w], level.square[w], kept);
    }
  }
  return kept;
}

/// In segments of one length, those out that cannot be searched.
Followed follow_in_segments(const model::Model& model, const Data& data, double length) {
  const Data segments = data.segments(length);
  const SettledWindows settled = settled_in_turn(model, segments, {});
  Level some = empty_level(data, length);
  for (const int w : segments.all_windows()) {
    const auto i = static_cast<std::size_t>(w);
    if (!settled.is_astray(w)) {
      add(segments.windows[i], settled.x0[i], mean_square(segments, w, settled), some);
    }
  }
  return trimmed(some).followed;
}

/// The shorter segments that lie in a longer one.
std::vector<std::size_t> inside(const Window& longer, const Data& shorter) {
  std::vector<std::size_t> some;
  for (std::size_t s = 0; s < shorter.windows.size(); ++s) {
    const Window& one = shorter.windows[s];
    if (one.trial == longer.trial && one.first >= longer.first &&
        one.first + one.count <= longer.first + longer.count) {
      some.push_back(s);
    }
  }
  return some;
}

/// Where the longer windows begin, of those whose first part is known.
std::vector<Eigen::VectorXd> starts_of(const Data& longer, const std::vector<std::vector<std::size_t>>& parts,
                                       const Followed& shorter) {
  std::vector<Eigen::VectorXd> starts(longer.windows.size());
  for (std::size_t w = 0; w < starts.size(); ++w) {
    if (!parts[w].empty() && shorter.data.windows[parts[w].front()].first == longer.windows[w].first) {
      starts[w] = shorter.x0[parts[w].front()];
    }
  }
  return starts;
}

/// Squared residuals of longer windows, if their mean squares are those of the worst of their parts.
std::vector<double> expected_of(const Data& longer, const std::vector<std::vector<std::size_t>>& parts,
                                const Level& level) {
  std::vector<double> expected;
  for (const int w : longer.all_windows()) {
    double most = 1.0;
    for (const std::size_t s : parts[static_cast<std::size_t>(w)]) {
      most = std::max(most, level.square[s]);
    }
    expected.push_back(most * readings(longer, w));
  }
  return expected;
}

/// Twice as long. Nothing where too many are lost, unless in any case.
std::optional<Level> lengthened(const model::Model& model, const Data& data, const Level& level,
                                bool in_any_case) {
  const Followed& shorter = level.followed;
  const double length = std::min(data.predict.window, 2.0 * shorter.length);
  const Data longer = data.segments(length);
  std::vector<std::vector<std::size_t>> parts;
  for (const Window& window : longer.windows) {
    parts.push_back(inside(window, shorter.data));
  }
  const std::size_t most = in_any_case ? kAnyNumber : most_lost(longer.windows.size());
  const SettledWindows settled = settled_in_turn(model, longer, starts_of(longer, parts, shorter),
                                                 expected_of(longer, parts, level), most);
  Level some = empty_level(data, length);
  std::size_t lost = 0;
  for (const int w : longer.all_windows()) {
    const auto i = static_cast<std::size_t>(w);
    if (!settled.is_astray(w)) {
      add(longer.windows[i], settled.x0[i], mean_square(longer, w, settled), some);
      continue;
    }
    ++lost;
    for (const std::size_t s : parts[i]) {
      add(shorter.data.windows[s], shorter.x0[s], level.square[s], some);
    }
  }
  if (lost > most) {
    return std::nullopt;
  }
  return trimmed(some);
}

/// With the present model's states and squares.
Level level_of(const model::Model& model, const Followed& followed) {
  const SettledWindows settled = settled_in_turn(model, followed.data, followed.x0);
  Level level{followed, {}};
  level.followed.x0 = settled.x0;
  for (const int w : followed.data.all_windows()) {
    level.square.push_back(mean_square(followed.data, w, settled));
  }
  return trimmed(level);
}

}  // namespace

bool is_whole(const Followed& followed) { return followed.length >= followed.data.predict.window; }

bool is_same(const Window& one, const Window& other) {
  return other.trial == one.trial && other.first == one.first && other.count == one.count;
}

std::size_t not_followed(const Data& data, const Followed& followed) {
  const std::vector<Window>& some = followed.data.windows;
  const std::vector<Window> all = data.segments(followed.length).windows;
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const Window& one) {
    return std::none_of(some.begin(), some.end(), [&](const Window& other) { return is_same(one, other); });
  }));
}

bool are_too_many_lost(const Data& data, const Followed& followed) {
  return not_followed(data, followed) > most_lost(data.segments(followed.length).windows.size());
}

Followed follow(const model::Model& model, const Data& data) {
  if (can_be_followed_whole(model, data)) {
    return follow_whole(model, data);
  }
  // Which length it is shows on a few windows.
  constexpr std::size_t kFew = 3;  // of each role
  const double window = data.predict.window;
  const Data few = data.thinned(kFew);
  const Followed tried = follow_in_segments(model, few, kFirstSegments * window);
  const double share = are_too_many_lost(few, tried) ? kShortestSegments : kFirstSegments;
  return follow_in_segments(model, data, share * window);
}

Followed follow_beginnings(const model::Model& model, const Data& data) {
  constexpr double kShare = 0.05;
  Followed beginnings = follow_whole(model, data.beginnings(kShare));
  beginnings.length = kShare * data.predict.window;
  return beginnings;
}

Followed follow_at(const model::Model& model, const Data& data, double length) {
  return length < data.predict.window ? follow_in_segments(model, data, length) : follow_whole(model, data);
}

Followed follow_further(const model::Model& model, const Data& data, const Followed& shorter,
                        bool in_any_case) {
  if (is_whole(shorter)) {
    return shorter;
  }
  Level level = level_of(model, shorter);
  std::optional<Level> longer = lengthened(model, data, level, in_any_case);
  return std::move(longer ? longer->followed : level.followed);
}

}  // namespace plumbline::validation
