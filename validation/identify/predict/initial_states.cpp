#include "validation/identify/predict/initial_states.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "validation/identify/predict/spread.h"

namespace plumbline::validation {
namespace {

/// Windows that follow each other in time without a gap, each in the order of time. With `segments_alone` a
/// run begins where a window does not continue another one.
std::vector<std::vector<int>> runs_of(const Data& data, bool segments_alone) {
  std::vector<int> order = data.all_windows();
  const auto at = [&](int w) -> const Window& { return data.windows[static_cast<std::size_t>(w)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::make_pair(at(a).trial, at(a).first) < std::make_pair(at(b).trial, at(b).first);
  });
  std::vector<std::vector<int>> runs;
  for (const int w : order) {
    const bool follows = !runs.empty() && (at(w).continues || !segments_alone) &&
                         at(runs.back().back()).trial == at(w).trial &&
                         at(runs.back().back()).first + at(runs.back().back()).count == at(w).first;
    if (!follows) {
      runs.emplace_back();
    }
    runs.back().push_back(w);
  }
  return runs;
}

/// Work on windows that changes their initial states and normal equations.
SharedItems spread_over(const std::string& name, const model::Model& model, const std::vector<int>& windows,
                        const std::function<void(int)>& work, Point& point, std::vector<Reduced>& reduced) {
  const auto result = [&](int i) {
    const auto at = static_cast<std::size_t>(windows[static_cast<std::size_t>(i)]);
    Record record;
    record.add(point.x0[at]);
    add(reduced[at], record);
    return record;
  };
  const auto take = [&](int i, const Record& record) {
    const auto at = static_cast<std::size_t>(windows[static_cast<std::size_t>(i)]);
    RecordReader reader(record);
    point.x0[at] = reader.vector();
    reduced[at] = reduced_from(reader);
  };
  constexpr double kSteps = 20.0;  // trajectories of a search, about
  return {name, cost_of(model, kSteps), work, result, take};
}

}  // namespace

std::vector<int> curved(const std::vector<Reduced>& reduced) {
  std::vector<int> some;
  for (std::size_t w = 0; w < reduced.size(); ++w) {
    if (reduced[w].curved) {
      some.push_back(static_cast<int>(w));
    }
  }
  return some;
}

void InitialStates::begin(Point& point) {
  const Data& data = pool_.data();
  point.x0.resize(data.windows.size());
  parallel_for(static_cast<int>(data.windows.size()), data.threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    if (point.x0[i].size() == 0) {
      pool_.with(w, parameters_, point.theta,
                 [&](Predictor& predictor) { point.x0[i] = predictor.search_start(data.windows[i]); });
    }
  });
}

std::vector<Reduced> InitialStates::reduce_at(const Point& point) {
  return reduce(pool_, pool_.data().all_windows(), parameters_, point.theta, point.x0, units_);
}

StateSearch InitialStates::search(int window, const Point& point) {
  return {pool_, window, parameters_, point.theta, units_};
}

std::vector<Reduced> InitialStates::reduce_those_that_run(const std::vector<int>& windows,
                                                          const Point& point) {
  std::vector<Reduced> all(windows.size());
  const auto work = [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    all[at] = search(windows[at], point).from(point.x0[static_cast<std::size_t>(windows[at])]).reduced;
  };
  for_each_item(pool_.data(), static_cast<int>(windows.size()),
                spread_of("reducing a window", pool_.model(), parameters_.size(), work, all));
  return all;
}

std::vector<Reduced> InitialStates::reduce_some(const std::vector<int>& windows, const Point& point) {
  std::vector<Reduced> all(pool_.data().windows.size());
  std::vector<Reduced> some = reduce_those_that_run(windows, point);
  for (std::size_t k = 0; k < windows.size(); ++k) {
    all[static_cast<std::size_t>(windows[k])] = std::move(some[k]);
  }
  return all;
}

std::vector<Reduced> InitialStates::reduce_or_begin_anew(Point& point) {
  std::vector<Reduced> all = reduce_those_that_run(pool_.data().all_windows(), point);
  for (std::size_t w = 0; w < all.size(); ++w) {
    if (!std::isfinite(all[w].raw_sse)) {
      point.x0[w].resize(0);
      begin(point);
      all[w] = reduce(pool_, {static_cast<int>(w)}, parameters_, point.theta, point.x0, units_).front();
    }
  }
  return all;
}

void InitialStates::settle(const std::vector<int>& windows, const Settling& settling, Point& point,
                           std::vector<Reduced>& reduced) {
  const auto work = [&](int i) {
    const int w = windows[static_cast<std::size_t>(i)];
    const auto at = static_cast<std::size_t>(w);
    Settled one{std::move(point.x0[at]), std::move(reduced[at])};
    search(w, point).settle(settling, one);
    point.x0[at] = std::move(one.x0);
    reduced[at] = std::move(one.reduced);
  };
  for_each_item(pool_.data(), static_cast<int>(windows.size()),
                spread_over("settling a window", pool_.model(), windows, work, point, reduced));
}

std::optional<Eigen::VectorXd> InitialStates::end_of_the_one_before(int window, int before,
                                                                    const Point& point) {
  const Window& here = pool_.data().windows[static_cast<std::size_t>(window)];
  std::optional<Eigen::VectorXd> end;
  const auto i = static_cast<std::size_t>(before);
  if (before < 0 || point.x0[i].size() == 0) {
    return end;
  }
  Window until = pool_.data().windows[i];
  until.count = here.first + 1 - until.first;
  pool_.with(before, parameters_, point.theta, [&](Predictor& predictor) {
    try {
      predictor.predict(until, point.x0[i]);
      end = predictor.predicted_states().rightCols<1>();
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      end.reset();  // it cannot be followed to its end
    }
  });
  return end;
}

void InitialStates::take_if_better(int window, Settled found, Point& point, Reduced& reduced) {
  const auto w = static_cast<std::size_t>(window);
  if (point.x0[w].size() == 0 || found.reduced.raw_sse < reduced.raw_sse) {
    point.x0[w] = std::move(found.x0);
    reduced = std::move(found.reduced);
  }
}

void InitialStates::try_start(int window, const Eigen::VectorXd& start, const Settling& settling,
                              Point& point, Reduced& reduced) {
  StateSearch one = search(window, point);
  Settled found = one.from(start);
  one.settle(settling, found);
  take_if_better(window, std::move(found), point, reduced);
}

void InitialStates::try_from_before(int window, int before, const Settling& settling, Point& point,
                                    Reduced& reduced) {
  const std::optional<Eigen::VectorXd> end = end_of_the_one_before(window, before, point);
  if (end) {
    try_start(window, *end, settling, point, reduced);
  }
}

void InitialStates::try_grown(int window, const Eigen::VectorXd& start, const Settling& settling,
                              Point& point, Reduced& reduced) {
  take_if_better(window, search(window, point).grown(start, settling), point, reduced);
}

Eigen::VectorXd InitialStates::measured_start(int window, const Point& point) {
  Eigen::VectorXd start;
  pool_.with(window, parameters_, point.theta, [&](Predictor& predictor) {
    start = predictor.search_start(pool_.data().windows[static_cast<std::size_t>(window)]);
  });
  return start;
}

void InitialStates::in_turn(bool segments_alone, const std::function<void(int window, int before)>& work) {
  const std::vector<std::vector<int>> runs = runs_of(pool_.data(), segments_alone);
  parallel_for(static_cast<int>(runs.size()), pool_.data().threads, [&](int r) {
    int before = -1;
    for (const int w : runs[static_cast<std::size_t>(r)]) {
      work(w, before);
      before = w;
    }
  });
}

std::vector<Reduced> InitialStates::settle_in_turn(const Settling& settling, Point& point,
                                                   const std::vector<double>& expected, std::size_t most) {
  const Data& data = pool_.data();
  point.x0.resize(data.windows.size());
  std::vector<Reduced> reduced(data.windows.size());
  const auto is_lost = [&](int w) { return is_astray(data, w, reduced, expected); };
  std::atomic<std::size_t> lost{0};
  in_turn(true, [&](int w, int before) {
    const auto i = static_cast<std::size_t>(w);
    reduced[i].raw_sse = reduced[i].sse = std::numeric_limits<double>::infinity();
    if (lost > most) {
      return;
    }
    Eigen::VectorXd start = point.x0[i];
    const bool is_given = start.size() > 0;
    if (is_given) {
      try_start(w, start, settling, point, reduced[i]);
    }
    if (!is_given || is_lost(w)) {
      try_from_before(w, before, settling, point, reduced[i]);
    }
    if (!is_given && is_above_floor(data, w, reduced[i].raw_sse)) {
      start = measured_start(w, point);
      try_start(w, start, settling, point, reduced[i]);
    }
    if (is_lost(w)) {
      try_grown(w, start, settling, point, reduced[i]);
    }
    if (is_lost(w)) {
      ++lost;
    }
  });
  return reduced;
}

void InitialStates::settle_lost(const std::vector<double>& promised, const Settling& settling,
                                bool thoroughly, const Point& from, Point& point,
                                std::vector<Reduced>& reduced) {
  const Data& data = pool_.data();
  const auto is_lost = [&](int w) { return is_astray(data, w, reduced, promised); };
  const std::vector<int> all = data.all_windows();
  if (static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_lost)) > most_lost(all.size())) {
    return;
  }
  in_turn(false, [&](int w, int before) {
    const auto i = static_cast<std::size_t>(w);
    if (is_lost(w)) {
      try_start(w, from.x0[i], settling, point, reduced[i]);
    }
    if (is_lost(w)) {
      try_from_before(w, before, settling, point, reduced[i]);
    }
    if (is_lost(w)) {
      const Eigen::VectorXd start = measured_start(w, point);
      try_start(w, start, settling, point, reduced[i]);
      if (thoroughly && is_lost(w)) {
        try_grown(w, start, settling, point, reduced[i]);
      }
    }
  });
}

std::vector<Reduced> InitialStates::settle_all(const Settling& settling, Point& point) {
  begin(point);
  std::vector<Reduced> reduced = reduce_or_begin_anew(point);
  settle(pool_.data().all_windows(), settling, point, reduced);
  return reduced;
}

void InitialStates::settle_anew(const std::vector<int>& windows, const Settling& settling, Point& point,
                                std::vector<Reduced>& reduced) {
  Point anew = point;
  for (const int w : windows) {
    anew.x0[static_cast<std::size_t>(w)].resize(0);
  }
  begin(anew);
  std::vector<Reduced> other = reduce_some(windows, anew);
  settle(windows, settling, anew, other);
  for (const int w : windows) {
    const auto i = static_cast<std::size_t>(w);
    if (other[i].raw_sse < reduced[i].raw_sse) {
      point.x0[i] = anew.x0[i];
      reduced[i] = std::move(other[i]);
    }
  }
}

void InitialStates::stay_where_better(const Point& from, const std::vector<Reduced>& before,
                                      const std::vector<int>& windows, Point& to,
                                      std::vector<Reduced>& after) {
  parallel_for(static_cast<int>(windows.size()), pool_.data().threads, [&](int k) {
    const int w = windows[static_cast<std::size_t>(k)];
    const auto i = static_cast<std::size_t>(w);
    if (after[i].raw_sse > before[i].raw_sse) {
      take_if_better(w, search(w, to).if_better(from.x0[i], after[i]), to, after[i]);
    }
  });
}

void InitialStates::shorten(const Point& from, const std::vector<Reduced>& before, Point& to,
                            std::vector<Reduced>& after) {
  constexpr int kHalvings = 6;
  constexpr int kInVain = 2;  // then it is the parameters' step that the window cannot bear
  constexpr double kHelps = 0.7;
  constexpr double kAllowed = 2.0;
  std::vector<int> worse = curved(before);
  std::vector<int> in_vain(before.size(), 0);
  Point shorter = to;
  stay_where_better(from, before, worse, to, after);
  for (int i = 0; i < kHalvings; ++i) {
    const auto is_done = [&](int w) {
      const auto at = static_cast<std::size_t>(w);
      return after[at].raw_sse <= kAllowed * before[at].raw_sse || in_vain[at] == kInVain;
    };
    worse.erase(std::remove_if(worse.begin(), worse.end(), is_done), worse.end());
    if (worse.empty()) {
      return;
    }
    for (const int w : worse) {
      const auto at = static_cast<std::size_t>(w);
      shorter.x0[at] = 0.5 * (shorter.x0[at] + from.x0[at]);
    }
    std::vector<Reduced> now(worse.size());
    parallel_for(static_cast<int>(worse.size()), pool_.data().threads, [&](int k) {
      const auto at = static_cast<std::size_t>(worse[static_cast<std::size_t>(k)]);
      now[static_cast<std::size_t>(k)] =
          search(static_cast<int>(at), shorter).if_better(shorter.x0[at], after[at]).reduced;
    });
    for (std::size_t k = 0; k < worse.size(); ++k) {
      const auto at = static_cast<std::size_t>(worse[k]);
      in_vain[at] = now[k].raw_sse < kHelps * after[at].raw_sse ? 0 : in_vain[at] + 1;
      if (!(after[at].raw_sse <= now[k].raw_sse)) {
        after[at] = now[k];
        to.x0[at] = shorter.x0[at];
      }
    }
  }
}

void InitialStates::take_last_step(Point& point, std::vector<Reduced>& reduced) {
  const std::vector<int> all = pool_.data().all_windows();
  const auto work = [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    Settled one{std::move(point.x0[i]), std::move(reduced[i])};
    search(w, point).take_last_step(one);
    point.x0[i] = std::move(one.x0);
    reduced[i] = std::move(one.reduced);
  };
  for_each_item(pool_.data(), static_cast<int>(reduced.size()),
                spread_over("a window's last step", pool_.model(), all, work, point, reduced));
}

std::vector<Reduced> settle_all(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                const Settling& settling, Point& at) {
  InitialStates states(pool, parameters, {});
  std::vector<Reduced> reduced = states.settle_all(settling, at);
  states.take_last_step(at, reduced);
  return reduced;
}

bool is_astray(const Data& data, int window, const std::vector<Reduced>& reduced,
               const std::vector<double>& expected) {
  constexpr double kKept = 2.0;
  constexpr double kPromised = 1.5;
  const auto i = static_cast<std::size_t>(window);
  const Reduced& one = reduced[i];
  return is_above_floor(data, window, one.raw_sse) &&
         !(one.raw_sse <= kKept * (expected.empty() ? one.sse : expected[i]) &&
           one.raw_sse <= kPromised * one.sse);
}

std::size_t most_lost(std::size_t windows) { return windows / 4; }

bool is_above_floor(const Data& data, int window, double sse, double fits) {
  return sse > fits * fits * readings(data, window);
}

std::vector<int> above_floor(const Data& data, const std::vector<Reduced>& reduced, double fits) {
  std::vector<int> some;
  for (const int w : data.all_windows()) {
    if (is_above_floor(data, w, reduced[static_cast<std::size_t>(w)].raw_sse, fits)) {
      some.push_back(w);
    }
  }
  return some;
}

}  // namespace plumbline::validation
