// Gauss-Newton on the reduced equations of all windows.
#include <algorithm>
#include <cmath>

#include "validation/predict/box_least_squares.h"
#include "validation/predict/foretell.h"

namespace plumbline::validation {
namespace {

/// Where the search stands: values, initial states and, once reduced, the equations there.
struct Point {
  Eigen::VectorXd theta;
  std::vector<Eigen::VectorXd> x0;
};

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

/// The windows that are not linear in where they begin.
std::vector<int> curved(const std::vector<Reduced>& reduced) {
  std::vector<int> some;
  for (std::size_t w = 0; w < reduced.size(); ++w) {
    if (reduced[w].curved) {
      some.push_back(static_cast<int>(w));
    }
  }
  return some;
}

struct Passes {
  PredictorPool& pool;
  const std::vector<FreeParameter>& parameters;
  std::vector<int> windows;

  std::vector<Reduced> reduce_at(const Point& point, const Eigen::VectorXd& units) {
    return reduce(pool, windows, parameters, point.theta, point.x0, units);
  }
  void shorten(const Point& from, const std::vector<Reduced>& before, const Eigen::VectorXd& units, Point& to,
               std::vector<Reduced>& after);
  void settle(const Eigen::VectorXd& units, Point& point, std::vector<Reduced>& reduced);
  void take_last_step(Point& point, std::vector<Reduced>& reduced);
};

/// Steps of the initial states alone, in windows that are not linear in them and whose next step still
/// promises much. The parameters' step is then that of windows that are at their best.
void Passes::settle(const Eigen::VectorXd& units, Point& point, std::vector<Reduced>& reduced) {
  constexpr int kSteps = 6;
  constexpr double kMuch = 0.05;
  constexpr double kShortest = 0.1;
  std::vector<int> open = curved(reduced);
  std::vector<double> share(reduced.size(), 1.0);  // of the step that is tried
  for (int i = 0; i < kSteps; ++i) {
    const auto is_settled = [&](int w) {
      const auto at = static_cast<std::size_t>(w);
      return reduced[at].raw_sse <= (1.0 + kMuch) * reduced[at].sse || share[at] < kShortest;
    };
    open.erase(std::remove_if(open.begin(), open.end(), is_settled), open.end());
    if (open.empty()) {
      return;
    }
    Point next = point;
    for (const int w : open) {
      const auto at = static_cast<std::size_t>(w);
      next.x0[at] += share[at] * reduced[at].x_shift;
    }
    const std::vector<Reduced> now = reduce(pool, open, parameters, point.theta, next.x0, units);
    for (std::size_t k = 0; k < open.size(); ++k) {
      const auto at = static_cast<std::size_t>(open[k]);
      const bool better = now[k].raw_sse < reduced[at].raw_sse;
      share[at] *= better ? 1.0 : 0.3;
      if (better) {
        reduced[at] = now[k];
        point.x0[at] = next.x0[at];
      }
    }
  }
}

/// Halves the steps of initial states that made their windows worse, as a touchdown missed or gained does:
/// the other windows' steps are none of their business. Where the parameters move too, a window may lose a
/// little.
void Passes::shorten(const Point& from, const std::vector<Reduced>& before, const Eigen::VectorXd& units,
                     Point& to, std::vector<Reduced>& after) {
  constexpr int kHalvings = 6;
  const double allowed = parameters.empty() ? 1.0 : 2.0;
  std::vector<int> worse = curved(before);
  Point shorter = to;
  for (int i = 0; i < kHalvings; ++i) {
    const auto is_fine = [&](int w) {
      const auto at = static_cast<std::size_t>(w);
      return after[at].raw_sse <= allowed * before[at].raw_sse;
    };
    worse.erase(std::remove_if(worse.begin(), worse.end(), is_fine), worse.end());
    if (worse.empty()) {
      return;
    }
    for (const int w : worse) {
      const auto at = static_cast<std::size_t>(w);
      shorter.x0[at] = 0.5 * (shorter.x0[at] + from.x0[at]);
    }
    const std::vector<Reduced> now = reduce(pool, worse, parameters, to.theta, shorter.x0, units);
    for (std::size_t k = 0; k < worse.size(); ++k) {
      const auto at = static_cast<std::size_t>(worse[k]);
      if (!(after[at].raw_sse <= now[k].raw_sse)) {
        after[at] = now[k];
        to.x0[at] = shorter.x0[at];
      }
    }
  }
}

/// The equations at hand promise one more step of every initial state. Where it would still matter it is
/// tried: taken when the window is the better for it, and its residuals are those that are there, not the
/// promised.
void Passes::take_last_step(Point& point, std::vector<Reduced>& reduced) {
  constexpr double kMatters = 1e-3;
  parallel_for(static_cast<int>(reduced.size()), pool.data().threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    Reduced& one = reduced[i];
    const Eigen::VectorXd there = point.x0[i] + one.x_shift;
    if (!one.curved || one.raw_sse <= (1.0 + kMatters) * one.sse) {
      point.x0[i] = there;
      return;
    }
    pool.with(w, parameters, point.theta, [&](Predictor& predictor) {
      const Window& window = pool.data().windows[i];
      Eigen::VectorXd r = predictor.residual(window, there);
      one.sse = r.squaredNorm() + predictor.anchor(window, there, r).r.squaredNorm();
      if (one.sse < one.raw_sse) {
        point.x0[i] = there;
      } else {
        r = predictor.residual(window, point.x0[i]);
        one.sse = one.raw_sse;
      }
      one.square = predictor.squares(window, r);
    });
  });
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
  Equations sum{known.H.asDiagonal(), known.g, 0.0, 0.0};
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
  const bool any = bounds.lower.size() > 0;
  Step step;
  if (any) {
    Eigen::MatrixXd H = sum.H;
    H.diagonal() *= 1.0 + damping;
    step.delta = box_least_squares(H, sum.g, bounds.lower, bounds.upper);
  }
  for (const Reduced& one : reduced) {
    step.x.push_back(any ? Eigen::VectorXd(one.x_shift - one.x_slope * step.delta) : one.x_shift);
  }
  return step;
}

/// Share of the cost that the linearised windows promise to remove.
double promise_of(const Equations& sum, const Step& step) {
  const double gain =
      step.delta.size() > 0 ? 2.0 * sum.g.dot(step.delta) - step.delta.dot(sum.H * step.delta) : 0.0;
  return (gain + sum.raw - sum.left) / std::max(sum.left, 1e-300);
}

/// Marquardt's damping: none until a step fails, then as much as was needed, less after each success.
class Damping {
 public:
  double value() const { return value_; }
  void more() { value_ = std::max(kFactor * value_, kFirst); }
  void less() { value_ = value_ > kLast ? value_ / kFactor : 0.0; }

 private:
  static constexpr double kFirst = 1e-3, kLast = 1e-5, kFactor = 10.0;
  double value_ = 0.0;
};

constexpr int kAttempts = 6;  // from no damping up to 10

bool is_finite(const std::vector<Reduced>& reduced) {
  return std::all_of(reduced.begin(), reduced.end(), [](const Reduced& one) {
    return std::isfinite(one.sse) && one.H.allFinite() && one.g.allFinite() && one.x_shift.allFinite();
  });
}

/// Has the model stops or play, and are there windows that can be shortened?
bool comes_in_parts(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                    const Eigen::VectorXd& theta) {
  const std::vector<Trial>& trials = pool.data().trials;
  if (std::all_of(trials.begin(), trials.end(), [](const Trial& one) { return !one.switches.empty(); })) {
    return false;
  }
  bool any = false;
  pool.with(0, parameters, theta, [&](Predictor& predictor) { any = !predictor.plant().jumps().empty(); });
  return any;
}

Estimate search(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& start_x0,
                const EstimateOptions& options) {
  const Data& data = pool.data();
  Passes passes{pool, parameters, data.all_windows()};
  Point here{start, start_x0};
  here.x0.resize(data.windows.size());
  parallel_for(static_cast<int>(data.windows.size()), data.threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    if (here.x0[i].size() == 0) {
      pool.with(w, parameters, start,
                [&](Predictor& predictor) { here.x0[i] = predictor.search_start(data.windows[i]); });
    }
  });
  const Eigen::VectorXd units = search_units(parameters, start);
  std::vector<Reduced> reduced = passes.reduce_at(here, units);
  if (!is_finite(reduced)) {
    throw std::runtime_error("the prediction is not finite at the start values");
  }
  passes.settle(units, here, reduced);
  Estimate result;
  Damping damping;
  for (result.iterations = 1; result.iterations < options.iterations; ++result.iterations) {
    const Prior known = prior(parameters, units, here.theta);
    const Equations sum = add_up(data, reduced, known);
    const Room bounds = room(parameters, here.theta, units);
    if (promise_of(sum, step_of(sum, reduced, bounds, 0.0)) < options.tolerance) {
      result.converged = true;
      break;
    }
    bool better = false;
    for (int attempt = 0; attempt < kAttempts && !better; ++attempt) {
      Point there = moved(here, step_of(sum, reduced, bounds, damping.value()), parameters, units);
      try {
        std::vector<Reduced> next = passes.reduce_at(there, units);
        passes.shorten(here, reduced, units, there, next);
        passes.settle(units, there, next);
        const double cost = train_cost(data, next) + prior(parameters, units, there.theta).square;
        if (is_finite(next) &&
            cost < (train_cost(data, reduced) + known.square) * (1.0 + options.tolerance)) {
          here = there;
          reduced = std::move(next);
          better = true;
        }
      } catch (const Stopped&) {
        throw;
      } catch (const std::runtime_error&) {
        // the integrator gave up there: a shorter step
      }
      better ? damping.less() : damping.more();
    }
    if (!better) {
      break;
    }
  }
  passes.take_last_step(here, reduced);
  result.theta = here.theta;
  result.x0 = here.x0;
  for (const Reduced& one : reduced) {
    result.square.push_back(one.square);
  }
  result.scores = score(data, result.square);
  result.predicted = prediction(data, reduced, parameters, here.theta, units);
  result.cost = train_cost(data, reduced) + prior(parameters, units, here.theta).square;
  return result;
}

/// On longer and longer beginnings of the windows, each from where the one before ended.
Point after_parts(PredictorPool& pool, const std::vector<FreeParameter>& parameters, Point at,
                  const EstimateOptions& options) {
  for (const Eigen::Index parts : {10, 5, 2}) {
    const Data data = pool.data().beginnings(parts);
    PredictorPool short_pool(pool.model(), data);
    Estimate part = search(short_pool, parameters, at.theta, at.x0, options);
    at = {std::move(part.theta), std::move(part.x0)};
  }
  return at;
}

/// The parameters with no room to move.
std::vector<FreeParameter> held(std::vector<FreeParameter> parameters, const Eigen::VectorXd& theta) {
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    parameters[p].lower = parameters[p].upper = theta[static_cast<Eigen::Index>(p)];
  }
  return parameters;
}

}  // namespace

Estimate gauss_newton(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                      const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& start_x0,
                      const EstimateOptions& options) {
  constexpr double kFits = 1.2;
  if (!options.by_parts || !comes_in_parts(pool, parameters, start)) {
    return search(pool, parameters, start, start_x0, options);
  }
  Point from{start, start_x0};
  if (from.x0.empty()) {
    from.x0 = after_parts(pool, held(parameters, start), from, {4, 1e-2}).x0;
  }
  Estimate direct = search(pool, parameters, start, from.x0, options);
  if (parameters.empty() || direct.scores.train < kFits) {
    return direct;
  }
  try {
    const Point near = after_parts(pool, parameters, from, options);
    Estimate by_parts = search(pool, parameters, near.theta, near.x0, options);
    return by_parts.cost < direct.cost ? by_parts : direct;
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return direct;  // on that way it cannot be integrated
  }
}

Room room(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
          const Eigen::VectorXd& units) {
  Room b{Eigen::VectorXd(units.size()), Eigen::VectorXd(units.size())};
  for (Eigen::Index p = 0; p < units.size(); ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const double here = to_search(parameter.scale, theta[p]);
    const double one = (to_search(parameter.scale, parameter.lower) - here) / units[p];
    const double two = (to_search(parameter.scale, parameter.upper) - here) / units[p];
    b.lower[p] = std::min({one, two, 0.0});
    b.upper[p] = std::max({one, two, 0.0});
  }
  return b;
}

}  // namespace plumbline::validation
