#include "validation/predict/initial_states.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace plumbline::validation {
namespace {

/// The steps of one window. One that made it worse is damped after Marquardt, which turns it away from what
/// the window hardly tells, where a straight line leads astray first; or merely shortened.
class StateSteps {
 public:
  explicit StateSteps(bool straight) : straight_(straight) {}
  bool is_at_end() const { return straight_ ? share_ < kShortest : damping_ > kMost; }
  void after(bool better) {
    share_ = better ? std::min(1.0, 2.0 * share_) : 0.3 * share_;
    if (better) {
      damping_ = damping_ > kFirst ? damping_ / kFactor : 0.0;
    } else {
      damping_ = std::max(kFactor * damping_, kFirst);
    }
  }
  /// share * shift, or (H + damping diag(H)) step = H shift.
  Eigen::VectorXd step(const Reduced& one) const {
    if (straight_ || damping_ == 0.0) {
      return (straight_ ? share_ : 1.0) * one.x_shift;
    }
    Eigen::MatrixXd H = one.x_H;
    H.diagonal() *= 1.0 + damping_;
    return H.ldlt().solve(one.x_H * one.x_shift);
  }

 private:
  static constexpr double kShortest = 0.01, kFirst = 1e-2, kFactor = 10.0, kMost = 10.0;
  bool straight_;
  double share_ = 1.0, damping_ = 0.0;
};

/// Squared residuals of a window that begins at x0, and of what is known of x0; r are those of the window.
/// Infinite where it cannot be integrated from there.
double cost(Predictor& predictor, const Window& window, const Eigen::VectorXd& x0, Eigen::VectorXd& r) {
  try {
    r = predictor.residual(window, x0);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return std::numeric_limits<double>::infinity();
  }
  return r.squaredNorm() + predictor.anchor(window, x0, r).r.squaredNorm();
}

/// Windows that follow each other in time without a gap, each in the order of time: a run begins where a
/// window does not continue another one.
std::vector<std::vector<int>> runs_of(const Data& data) {
  std::vector<int> order = data.all_windows();
  const auto at = [&](int w) -> const Window& { return data.windows[static_cast<std::size_t>(w)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::make_pair(at(a).trial, at(a).first) < std::make_pair(at(b).trial, at(b).first);
  });
  std::vector<std::vector<int>> runs;
  for (const int w : order) {
    const bool follows = !runs.empty() && at(w).continues && at(runs.back().back()).trial == at(w).trial &&
                         at(runs.back().back()).first + at(runs.back().back()).count == at(w).first;
    if (!follows) {
      runs.emplace_back();
    }
    runs.back().push_back(w);
  }
  return runs;
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

bool is_settled(const Reduced& reduced, const Settling& settling) {
  return reduced.raw_sse <= (1.0 + settling.much) * reduced.sse;
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

Reduced InitialStates::reduce_if_it_runs(int window, const Point& point) {
  try {
    return reduce(pool_, {window}, parameters_, point.theta, point.x0, units_).front();
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    Reduced none;
    none.raw_sse = none.sse = std::numeric_limits<double>::infinity();
    return none;
  }
}

std::vector<Reduced> InitialStates::reduce_those_that_run(const std::vector<int>& windows,
                                                          const Point& point) {
  std::vector<Reduced> all(windows.size());
  parallel_for(static_cast<int>(windows.size()), pool_.data().threads, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    all[at] = reduce_if_it_runs(windows[at], point);
  });
  return all;
}

std::vector<Reduced> InitialStates::reduce_those_better(const std::vector<int>& windows, const Point& point,
                                                        const std::vector<Reduced>& than) {
  std::vector<Reduced> all(windows.size());
  parallel_for(static_cast<int>(windows.size()), pool_.data().threads, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    const int w = windows[at];
    const auto place = static_cast<std::size_t>(w);
    pool_.with(w, parameters_, point.theta, [&](Predictor& predictor) {
      Eigen::VectorXd r;
      all[at].raw_sse = cost(predictor, pool_.data().windows[place], point.x0[place], r);
    });
    if (!(than[place].raw_sse <= all[at].raw_sse)) {
      all[at] = reduce_if_it_runs(w, point);
    }
  });
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

void InitialStates::settle(std::vector<int> open, const Settling& settling, Point& point,
                           std::vector<Reduced>& reduced) {
  std::vector<StateSteps> steps(reduced.size(), StateSteps(settling.straight));
  for (int i = 0; i < settling.steps; ++i) {
    const auto is_done = [&](int w) {
      const auto at = static_cast<std::size_t>(w);
      return is_settled(reduced[at], settling) || steps[at].is_at_end();
    };
    open.erase(std::remove_if(open.begin(), open.end(), is_done), open.end());
    if (open.empty()) {
      return;
    }
    Point next = point;
    for (const int w : open) {
      const auto at = static_cast<std::size_t>(w);
      next.x0[at] += steps[at].step(reduced[at]);
    }
    const std::vector<Reduced> now = reduce_those_better(open, next, reduced);
    for (std::size_t k = 0; k < open.size(); ++k) {
      const auto at = static_cast<std::size_t>(open[k]);
      const bool better = now[k].raw_sse < reduced[at].raw_sse;
      steps[at].after(better);
      if (better) {
        reduced[at] = now[k];
        point.x0[at] = next.x0[at];
      }
    }
  }
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

// Works on a copy: windows of other runs are settled at the same time.
void InitialStates::try_start(int window, const Eigen::VectorXd& start, const Settling& settling,
                              Point& point, Reduced& reduced) {
  const auto w = static_cast<std::size_t>(window);
  Point one{point.theta, std::vector<Eigen::VectorXd>(point.x0.size())};
  one.x0[w] = start;
  std::vector<Reduced> found = reduce_some({window}, one);
  settle({window}, settling, one, found);
  if (point.x0[w].size() == 0 || found[w].raw_sse < reduced.raw_sse) {
    reduced = std::move(found[w]);
    point.x0[w] = one.x0[w];
  }
}

void InitialStates::try_from_before(int window, int before, const Settling& settling, Point& point,
                                    Reduced& reduced) {
  const std::optional<Eigen::VectorXd> end = end_of_the_one_before(window, before, point);
  if (end) {
    try_start(window, *end, settling, point, reduced);
  }
}

void InitialStates::try_from_measurements(int window, const Settling& settling, Point& point,
                                          Reduced& reduced) {
  Eigen::VectorXd measured;
  pool_.with(window, parameters_, point.theta, [&](Predictor& predictor) {
    measured = predictor.search_start(pool_.data().windows[static_cast<std::size_t>(window)]);
  });
  try_start(window, measured, settling, point, reduced);
}

void InitialStates::in_turn(const std::function<void(int window, int before)>& work) {
  const std::vector<std::vector<int>> runs = runs_of(pool_.data());
  parallel_for(static_cast<int>(runs.size()), pool_.data().threads, [&](int r) {
    int before = -1;
    for (const int w : runs[static_cast<std::size_t>(r)]) {
      work(w, before);
      before = w;
    }
  });
}

std::vector<Reduced> InitialStates::settle_in_turn(const Settling& settling, Point& point) {
  const Data& data = pool_.data();
  point.x0.resize(data.windows.size());
  std::vector<Reduced> reduced(data.windows.size());
  in_turn([&](int w, int before) {
    const auto i = static_cast<std::size_t>(w);
    const bool given = point.x0[i].size() > 0;
    reduced[i].raw_sse = reduced[i].sse = std::numeric_limits<double>::infinity();
    const auto is_lost = [&] { return is_above_floor(data, w, reduced[i].raw_sse); };
    if (given) {
      try_start(w, Eigen::VectorXd(point.x0[i]), settling, point, reduced[i]);
    }
    if (is_lost()) {
      try_from_before(w, before, settling, point, reduced[i]);
    }
    if (is_lost() && !given) {
      try_from_measurements(w, settling, point, reduced[i]);
    }
  });
  return reduced;
}

void InitialStates::settle_lost(const std::vector<double>& promised, const Settling& settling,
                                const Point& from, Point& point, std::vector<Reduced>& reduced) {
  constexpr double kKept = 2.0;
  constexpr std::ptrdiff_t kOneOf = 4;  // where more are lost it is not their states that are wrong
  const Data& data = pool_.data();
  const auto is_lost = [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    return is_above_floor(data, w, reduced[i].raw_sse) && !(reduced[i].raw_sse <= kKept * promised[i]);
  };
  const std::vector<int> all = data.all_windows();
  if (kOneOf * std::count_if(all.begin(), all.end(), is_lost) > static_cast<std::ptrdiff_t>(all.size())) {
    return;
  }
  in_turn([&](int w, int before) {
    const auto i = static_cast<std::size_t>(w);
    if (is_lost(w)) {
      try_start(w, from.x0[i], settling, point, reduced[i]);
    }
    if (is_lost(w)) {
      try_from_before(w, before, settling, point, reduced[i]);
    }
    if (is_lost(w)) {
      try_from_measurements(w, settling, point, reduced[i]);
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

void InitialStates::shorten(const Point& from, const std::vector<Reduced>& before, Point& to,
                            std::vector<Reduced>& after) {
  constexpr int kHalvings = 6;
  constexpr int kInVain = 2;  // then it is the parameters' step that the window cannot bear
  constexpr double kHelps = 0.7;
  constexpr double kAllowed = 2.0;
  std::vector<int> worse = curved(before);
  std::vector<int> in_vain(before.size(), 0);
  Point shorter = to;
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
    const std::vector<Reduced> now = reduce_those_better(worse, shorter, after);
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
  constexpr double kMatters = 1e-3;
  parallel_for(static_cast<int>(reduced.size()), pool_.data().threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    Reduced& one = reduced[i];
    const Eigen::VectorXd there = point.x0[i] + one.x_shift;
    if (!one.curved || one.raw_sse <= (1.0 + kMatters) * one.sse) {
      point.x0[i] = there;
      return;
    }
    pool_.with(w, parameters_, point.theta, [&](Predictor& predictor) {
      const Window& window = pool_.data().windows[i];
      Eigen::VectorXd r;
      one.sse = cost(predictor, window, there, r);
      if (one.sse < one.raw_sse) {
        point.x0[i] = there;
      } else {
        one.sse = cost(predictor, window, point.x0[i], r);
      }
      one.square = predictor.squares(window, r);
    });
  });
}

std::vector<Reduced> settle_all(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                const Settling& settling, Point& at) {
  InitialStates states(pool, parameters, {});
  std::vector<Reduced> reduced = states.settle_all(settling, at);
  states.take_last_step(at, reduced);
  return reduced;
}

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
