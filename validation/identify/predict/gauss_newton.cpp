// Gauss-Newton on the reduced equations of all windows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/trace/error.h"
#include "validation/identify/predict/box_least_squares.h"
#include "validation/identify/predict/foretell.h"
#include "validation/identify/predict/initial_states.h"
#include "validation/identify/predict/kept_keys.h"
#include "validation/identify/predict/states_by_parts.h"

namespace plumbline::validation {
namespace {

struct Step {
  Eigen::VectorXd delta;           // parameters, search units
  std::vector<Eigen::VectorXd> x;  // change of each initial state
};

Point moved(const Point& from, const Step& step, const std::vector<FreeParameter>& parameters,
            const Eigen::VectorXd& units) {
  Point to = from;
  for (Eigen::Index p = 0; p < units.size(); ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const double search = to_search(parameter.scale, from.theta[p]) + step.delta[p] * units[p];
    to.theta[p] = std::clamp(from_search(parameter.scale, search), parameter.lower, parameter.upper);
  }
  for (std::size_t w = 0; w < to.x0.size(); ++w) {
    to.x0[w] += step.x[w];
  }
  return to;
}

/// Squared residuals of the train windows, with what their initial states' next step promises; of
/// curved ones, where a promise is not to be trusted, as they are.
double train_cost(const Data& data, const std::vector<Reduced>& reduced) {
  double cost = 0.0;
  for (std::size_t w = 0; w < reduced.size(); ++w) {
    const double one = reduced[w].curved ? reduced[w].raw_sse : reduced[w].sse;
    cost += data.role(w) == Role::train ? one : 0.0;
  }
  return cost;
}

/// Sums over the windows: equations of the train windows and of what is known beforehand, and what the
/// initial states' own move brings.
struct Equations {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double raw = 0.0, left = 0.0;
};

Equations add_up(const Data& data, const std::vector<Reduced>& reduced, const Prior& known) {
  Equations sum{known.H, known.g, 0.0, 0.0};
  for (std::size_t w = 0; w < reduced.size(); ++w) {
    sum.raw += reduced[w].raw_sse;
    sum.left += reduced[w].sse;
    if (data.role(w) == Role::train) {
      sum.H += reduced[w].H;
      sum.g += reduced[w].g;
    }
  }
  return sum;
}

/// Parameters from (H + damping diag(H)) delta = g within their room, every initial state after them.
Step step_of(const Equations& sum, const std::vector<Reduced>& reduced, const Room& bounds, double damping) {
  Step step;
  Eigen::MatrixXd H = sum.H;
  H.diagonal() *= 1.0 + damping;
  step.delta = box_least_squares(H, sum.g, bounds.lower, bounds.upper);
  for (const Reduced& one : reduced) {
    step.x.push_back(one.x_shift - one.x_slope * step.delta);
  }
  return step;
}

/// Shares of the cost that the linearised windows promise to remove.
struct Promise {
  double parameters;  // by the parameters' step
  double all;         // with the initial states' own
};

Promise promise_of(const Equations& sum, const Step& step) {
  const double gain = 2.0 * sum.g.dot(step.delta) - step.delta.dot(sum.H * step.delta);
  const double left = std::max(sum.left, 1e-300);
  return {gain / left, (gain + sum.raw - sum.left) / left};
}

/// Marquardt's damping: none until a step fails, then as much as was needed; less once the same has been
/// enough twice in a row.
class Damping {
 public:
  double value() const { return value_; }
  /// After a step that left so many times the cost. A ruinous one was not a little too long: far more at
  /// once. False when there is no more.
  bool after_failure(double times) {
    failed_ = true;
    if (value_ == kMost) {
      return false;
    }
    value_ = std::min(kMost, std::max(kFactor * value_, kFirst) * (times > kRuinous ? kRuinFactor : 1.0));
    return true;
  }
  void after_success() {
    if (!failed_) {
      value_ = value_ > kLast ? value_ / kFactor : 0.0;
    }
    failed_ = false;
  }

 private:
  static constexpr double kFirst = 1e-3, kLast = 1e-5, kMost = 100.0, kFactor = 10.0;
  static constexpr double kRuinous = 100.0, kRuinFactor = 100.0;
  double value_ = 0.0;
  bool failed_ = false;  // since the last success
};

bool is_finite(const std::vector<Reduced>& reduced) {
  return std::all_of(reduced.begin(), reduced.end(), [](const Reduced& one) {
    return std::isfinite(one.sse) && one.H.allFinite() && one.g.allFinite() && one.x_shift.allFinite();
  });
}

void expect_finite(const std::vector<Reduced>& reduced) {
  if (!is_finite(reduced)) {
    throw std::runtime_error("the prediction is not finite at the start values");
  }
}

/// Windows as they begin, without a search: some cannot be integrated from there.
Estimate as_it_begins(PredictorPool& pool, const std::vector<FreeParameter>& parameters, Point at) {
  InitialStates(pool, parameters, {}).begin(at);
  Estimate result;
  result.square = squares(pool, parameters, at.theta, at.x0);
  result.scores = score(pool.data(), result.square);
  result.predicted = {at.theta, result.square, result.scores};
  result.cost = std::numeric_limits<double>::infinity();
  result.theta = std::move(at.theta);
  result.x0 = std::move(at.x0);
  return result;
}

Estimate estimate_at(const Data& data, const Point& point, const std::vector<Reduced>& reduced,
                     const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& units) {
  Estimate result;
  result.theta = point.theta;
  result.x0 = point.x0;
  for (const Reduced& one : reduced) {
    result.square.push_back(one.square);
  }
  result.scores = score(data, result.square);
  result.predicted = prediction(data, reduced, parameters, point.theta, units);
  result.cost = train_cost(data, reduced) + prior(parameters, units, point.theta).square;
  return result;
}

/// The parameters as they are.
Estimate initial_states(PredictorPool& pool, const std::vector<FreeParameter>& parameters, Point at,
                        const EstimateOptions& options) {
  constexpr int kStepsOfIteration = 6;
  if (at.x0.empty() && pool.data().has_segments()) {
    InitialStates(pool, parameters, {}).settle_in_turn(kRoughly, at);
  }
  const std::vector<Reduced> reduced =
      settle_all(pool, parameters, {kStepsOfIteration * options.iterations, options.tolerance}, at);
  expect_finite(reduced);
  Estimate result = estimate_at(pool.data(), at, reduced, {}, {});
  result.converged = true;
  return result;
}

/// A search from one point to the next.
class Search {
 public:
  Search(PredictorPool& pool, const std::vector<FreeParameter>& parameters, const Point& from,
         const EstimateOptions& options)
      : data_(pool.data()),
        parameters_(parameters),
        options_(options),
        units_(search_units(parameters, from.theta)),
        states_(pool, parameters, units_),
        here_(from) {
    begin(pool);
    if (data_.has_segments()) {
      reduced_ = states_.reduce_some(data_.all_windows(), here_);
      states_.settle(curved(reduced_), {}, here_, reduced_);
      states_.settle_lost(typical(reduced_), {}, false, Point(here_), here_, reduced_);
    } else {
      reduced_ = states_.reduce_at(here_);
      states_.settle(curved(reduced_), {}, here_, reduced_);
    }
    expect_finite(reduced_);
    for (const Reduced& one : reduced_) {
      is_curved_.push_back(one.curved);
    }
  }

  Estimate run() {
    int iterations = 1;
    bool at_end = false;
    for (int slow = 0; iterations < options_.iterations && !at_end; ++iterations) {
      const double before = cost();
      at_end = !step();
      slow = at_end || cost() < (1.0 - options_.tolerance) * before ? 0 : slow + 1;
      at_end = at_end || slow == kSlow;
    }
    // A search that was cut short is gone on with, or not worth the pains.
    states_.settle_lost(typical(reduced_), kRoughly, at_end, Point(here_), here_, reduced_);
    keep_marks(reduced_);
    states_.take_last_step(here_, reduced_);
    Estimate result = estimate_at(data_, here_, reduced_, parameters_, units_);
    result.iterations = iterations;
    result.converged = at_end;
    return result;
  }

 private:
  /// Initial states that are not given.
  void begin(PredictorPool& pool) {
    here_.x0.resize(data_.windows.size());
    const bool all_given = std::none_of(here_.x0.begin(), here_.x0.end(),
                                        [](const Eigen::VectorXd& one) { return one.size() == 0; });
    if (data_.has_segments() && !all_given) {
      InitialStates(pool, parameters_, {}).settle_in_turn(kRoughly, here_);
    } else {
      states_.begin(here_);
    }
  }

  static constexpr int kSlow = 3;  // steps in a row that gain next to nothing: what is promised is not there

  /// False where no step would help, by what it promises or by trying.
  bool step() {
    const Equations sum = add_up(data_, reduced_, prior(parameters_, units_, here_.theta));
    const Room bounds = room(parameters_, here_.theta, units_);
    const Promise promise = promise_of(sum, step_of(sum, reduced_, bounds, 0.0));
    if (promise.all < options_.tolerance) {
      return false;
    }
    // Damping shortens the parameters' step alone: where that promises nothing, it changes nothing.
    const bool can_damp = promise.parameters >= options_.tolerance;
    while (true) {
      const double times =
          go_if_better(moved(here_, step_of(sum, reduced_, bounds, damping_.value()), parameters_, units_));
      if (times < 1.0) {
        damping_.after_success();
        return true;
      }
      if (!can_damp || !damping_.after_failure(times)) {
        return false;
      }
    }
  }

  /// The cost there in units of the present one with its tolerance; infinite where it cannot be integrated.
  double go_if_better(Point there) {
    try {
      std::vector<Reduced> next = states_.reduce_some(data_.all_windows(), there);
      mark_curved(next);
      states_.shorten(here_, reduced_, there, next);
      keep_marks(next);
      states_.settle(curved(next), {}, there, next);
      keep_marks(next);
      double times = times_here(there, next);
      if (!(times < 1.0)) {  // a window that was lost on the way may be all that is wrong with the step
        states_.settle_lost(promised(there), kRoughly, false, here_, there, next);
        keep_marks(next);
        times = times_here(there, next);
      }
      if (times < 1.0) {
        here_ = std::move(there);
        reduced_ = std::move(next);
      }
      return times;
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      return std::numeric_limits<double>::infinity();  // the integrator gave up there: a shorter step
    }
  }

  /// The cost of a point in units of the present one with its tolerance; infinite where it is not finite.
  double times_here(const Point& there, const std::vector<Reduced>& next) const {
    return is_finite(next) ? cost_of(there, next) / (cost() * (1.0 + options_.tolerance))
                           : std::numeric_limits<double>::infinity();
  }

  /// A straight line led these windows far astray: from now on their states' steps are damped, and their
  /// squared residuals count as they are. A damping of the parameters alone would refuse every step for them.
  /// Where more than a quarter are, it is the parameters' step that is too long.
  void mark_curved(std::vector<Reduced>& next) {
    constexpr double kAstray = 4.0;
    std::vector<std::size_t> astray;
    for (std::size_t w = 0; w < next.size(); ++w) {
      if (!is_curved_[w] && !(next[w].raw_sse <= kAstray * reduced_[w].raw_sse) &&
          is_above_floor(data_, static_cast<int>(w), next[w].raw_sse)) {
        astray.push_back(w);
      }
    }
    if (astray.size() <= most_lost(next.size())) {
      for (const std::size_t w : astray) {
        is_curved_[w] = reduced_[w].curved = true;
      }
    }
    keep_marks(next);
  }
  void keep_marks(std::vector<Reduced>& next) const {
    for (std::size_t w = 0; w < next.size(); ++w) {
      next[w].curved = is_curved_[w];
    }
  }

  /// Squared residuals that each window would have if its mean square were the median of all: far more is a
  /// state that was lost.
  std::vector<double> typical(const std::vector<Reduced>& reduced) const {
    std::vector<double> squares;
    for (const int w : data_.all_windows()) {
      squares.push_back(reduced[static_cast<std::size_t>(w)].raw_sse / readings(data_, w));
    }
    std::vector<double> sorted = squares;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    for (const int w : data_.all_windows()) {
      squares[static_cast<std::size_t>(w)] = *middle * readings(data_, w);
    }
    return squares;
  }

  /// Squared residuals of each window at the point's parameters, as the equations here foretell them.
  std::vector<double> promised(const Point& there) const {
    Eigen::VectorXd delta(units_.size());
    for (Eigen::Index p = 0; p < units_.size(); ++p) {
      const effects::Scale scale = parameters_[static_cast<std::size_t>(p)].scale;
      delta[p] = (to_search(scale, there.theta[p]) - to_search(scale, here_.theta[p])) / units_[p];
    }
    std::vector<double> squares;
    for (const Reduced& one : reduced_) {
      squares.push_back(one.sse - 2.0 * one.g.dot(delta) + delta.dot(one.H * delta));
    }
    return squares;
  }

  double cost_of(const Point& at, const std::vector<Reduced>& reduced) const {
    return train_cost(data_, reduced) + prior(parameters_, units_, at.theta).square;
  }
  double cost() const { return cost_of(here_, reduced_); }

  const Data& data_;
  const std::vector<FreeParameter>& parameters_;
  const EstimateOptions& options_;
  Eigen::VectorXd units_;
  InitialStates states_;
  Point here_;
  std::vector<Reduced> reduced_;
  std::vector<bool> is_curved_;
  Damping damping_;
};

Estimate search(PredictorPool& pool, const std::vector<FreeParameter>& parameters, const Point& from,
                const EstimateOptions& options) {
  return parameters.empty() ? initial_states(pool, parameters, from, options)
                            : Search(pool, parameters, from, options).run();
}

/// Parameters and initial states on longer and longer beginnings of the windows.
Point after_parts(PredictorPool& pool, const std::vector<FreeParameter>& parameters, Point at,
                  const EstimateOptions& options) {
  for (const double share : {0.1, 0.2, 0.5}) {
    const Data data = pool.data().beginnings(share);
    PredictorPool part(pool.model(), data);
    Estimate found = search(part, parameters, at, options);
    at = {std::move(found.theta), std::move(found.x0)};
  }
  return at;
}

/// Directly, and with stops or play also by way of the windows' beginnings.
Estimate searched(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                  const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& start_x0,
                  const EstimateOptions& options) {
  Point from{start, start_x0};
  if (pool.data().has_segments() || !options.by_parts || !has_corners(pool, parameters, start)) {
    return search(pool, parameters, from, options);
  }
  if (from.x0.empty()) {
    // Where the values are still to be searched, windows that they do not explain are not worth the pains.
    from =
        parameters.empty() ? grown_states(pool, parameters, start) : states_by_parts(pool, parameters, start);
  }
  Estimate direct = search(pool, parameters, from, options);
  if (parameters.empty() || direct.scores.train < kFits) {
    return direct;
  }
  try {
    const Point near = after_parts(pool, parameters, from, options);
    Estimate by_parts = search(pool, parameters, near, options);
    return by_parts.cost < direct.cost ? by_parts : direct;
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return direct;  // on that way it cannot be integrated
  }
}

}  // namespace

bool is_finite(const Estimate& estimate) {
  return std::isfinite(estimate.cost) && std::isfinite(estimate.scores.square());
}

Estimate gauss_newton(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                      const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& start_x0,
                      const EstimateOptions& options) {
  ResultKey key = key_of("gauss_newton", pool.model(), pool.data());
  add_parameters(parameters, key);
  key.numbers.add(start).add(start_x0);
  key.numbers.add(options.iterations).add(options.tolerance).add(options.by_parts ? 1.0 : 0.0);
  return estimate_from(kept(pool.data(), key,
                            [&] { return record_of(searched(pool, parameters, start, start_x0, options)); }));
}

Estimate try_gauss_newton(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                          const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& start_x0,
                          const EstimateOptions& options) {
  try {
    return gauss_newton(pool, parameters, start, start_x0, options);
  } catch (const Stopped&) {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error&) {
    return as_it_begins(pool, parameters, {start, start_x0});
  }
}

Estimate estimate_states(PredictorPool& pool, const std::vector<Eigen::VectorXd>& start_x0) {
  return try_gauss_newton(pool, {}, Eigen::VectorXd(), start_x0, {8, 1e-4});
}

Estimate rough_states(PredictorPool& pool) {
  if (!has_corners(pool, {}, {})) {
    return estimate_states(pool);
  }
  constexpr int kIterations = 4;
  return gauss_newton(pool, {}, {}, states_by_parts(pool, {}, {}).x0, {kIterations, kRoughly.much});
}

Room room(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
          const Eigen::VectorXd& units) {
  constexpr double kShareOfWay = 0.9;
  Room b{Eigen::VectorXd(units.size()), Eigen::VectorXd(units.size())};
  for (Eigen::Index p = 0; p < units.size(); ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const double here = to_search(parameter.scale, theta[p]);
    const double share = parameter.leaves_at_bound ? kShareOfWay : 1.0;
    const double one = share * (to_search(parameter.scale, parameter.lower) - here) / units[p];
    const double two = share * (to_search(parameter.scale, parameter.upper) - here) / units[p];
    b.lower[p] = std::min({one, two, 0.0});
    b.upper[p] = std::max({one, two, 0.0});
  }
  return b;
}

}  // namespace plumbline::validation
