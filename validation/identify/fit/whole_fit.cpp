#include "validation/identify/fit/whole_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/optimise/cma_search.h"
#include "validation/identify/predict/flight_start.h"

namespace plumbline::validation {
namespace {

constexpr std::uint64_t kSeed = 1;  // of the search and the draws: a fit is repeatable

/// Every stretch of every recording as one window.
Data in_one_piece(const Data& data) {
  constexpr Eigen::Index kFewest = 5;
  Data whole = data;
  whole.windows.clear();
  for (std::size_t t = 0; t < data.trials.size(); ++t) {
    const Trial& trial = data.trials[t];
    for (const Stretch& stretch : stretches_of(trial)) {
      if (stretch.end - stretch.first >= kFewest) {
        whole.windows.push_back({static_cast<int>(t), stretch.first, stretch.end - stretch.first, {}, false});
      }
    }
  }
  return whole;
}

/// The recordings and where each begins.
class Recordings {
 public:
  Recordings(const model::Model& model, const Data& data, std::vector<FreeParameter> parameters,
             const Eigen::VectorXd& given)
      : data_(in_one_piece(data)), pool_(model, data_), parameters_(std::move(parameters)) {
    const std::size_t n = data_.windows.size();
    x0_.resize(n);
    rest_.resize(static_cast<Eigen::Index>(n));
    for_each(data_.all_windows(), given, [&](Predictor& predictor, int w) {
      const Window& window = data_.windows[static_cast<std::size_t>(w)];
      const Trial& trial = data_.trials[static_cast<std::size_t>(window.trial)];
      x0_[static_cast<std::size_t>(w)] = state_at_start(predictor, trial, window);
      Eigen::MatrixXd rest(1, predictor.channels());
      for (Eigen::Index c = 0; c < rest.cols(); ++c) {
        rest(0, c) = trial.measured[static_cast<std::size_t>(c)].values[window.first];
      }
      rest_[w] = error_of_motion(predictor, trial, window, rest);
    });
  }

  const Data& data() const { return data_; }

  /// Of these windows.
  Eigen::VectorXd errors(const std::vector<int>& windows, const Eigen::VectorXd& theta) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data_.windows.size()));
    for_each(windows, theta, [&](Predictor& predictor, int w) { all[w] = error_of(predictor, w); });
    Eigen::VectorXd some(static_cast<Eigen::Index>(windows.size()));
    for (std::size_t i = 0; i < windows.size(); ++i) {
      some[static_cast<Eigen::Index>(i)] = all[windows[i]];
    }
    return some;
  }

  double mean_error(Role role, const Eigen::VectorXd& theta) {
    const std::vector<int> windows = data_.windows_of(role);
    return windows.empty() ? 0.0 : errors(windows, theta).mean();
  }

 private:
  template <typename Work>
  void for_each(const std::vector<int>& windows, const Eigen::VectorXd& theta, const Work& work) {
    parallel_for(static_cast<int>(windows.size()), data_.threads, [&](int i) {
      if (data_.stop != nullptr && data_.stop->raised) {
        throw Stopped();
      }
      const int w = windows[static_cast<std::size_t>(i)];
      pool_.with(w, parameters_, theta, [&](Predictor& predictor) { work(predictor, w); });
    });
  }

  /// One that cannot be integrated to its end stays where it was after the last quarter that it was
  /// integrated through.
  double error_of(Predictor& predictor, int w) const {
    const auto i = static_cast<std::size_t>(w);
    const Window& window = data_.windows[i];
    const Trial& trial = data_.trials[static_cast<std::size_t>(window.trial)];
    for (const double share : {1.0, 0.75, 0.5, 0.25}) {
      const Window part = beginning_of(window, trial, share);
      try {
        const double error = error_of_motion(predictor, trial, window, predictor.predict(part, x0_[i]));
        if (std::isfinite(error)) {
          return error;
        }
      } catch (const std::runtime_error&) {
        continue;
      }
    }
    return rest_[w];
  }

  Data data_;
  PredictorPool pool_;
  std::vector<FreeParameter> parameters_;
  std::vector<Eigen::VectorXd> x0_;
  Eigen::VectorXd rest_;
};

/// A set of values and the errors of the train recordings with it.
struct Tried {
  Eigen::VectorXd theta, errors;
};

/// Is it searched in its logarithm? What cannot be below zero is not to end there for a step that was too
/// long.
bool is_positive(const FreeParameter& parameter, double start) {
  return parameter.scale == effects::Scale::linear && parameter.lower >= 0.0 && start > 0.0;
}

/// From `start`, in the coordinates in which parameters are searched.
Eigen::VectorXd values_at(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& start,
                          const Eigen::VectorXd& units, const Eigen::VectorXd& delta) {
  Eigen::VectorXd theta = start;
  for (Eigen::Index p = 0; p < theta.size(); ++p) {
    const FreeParameter& one = parameters[static_cast<std::size_t>(p)];
    const double value = is_positive(one, start[p])
                             ? start[p] * std::exp(delta[p] * units[p] / start[p])
                             : from_search(one.scale, to_search(one.scale, start[p]) + delta[p] * units[p]);
    theta[p] = std::clamp(value, one.lower, one.upper);
  }
  return theta;
}

std::size_t best_of(const std::vector<Tried>& tried) {
  const auto best = std::min_element(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) {
    return a.errors.mean() < b.errors.mean();
  });
  return static_cast<std::size_t>(best - tried.begin());
}

struct Found {
  std::vector<Tried> tried;
  int generations = 0;
  bool settled = false;
};

Found searched(Recordings& recordings, const std::vector<FreeParameter>& parameters,
               const Eigen::VectorXd& start, const FitOptions& options, const Progress& progress) {
  constexpr int kPatience = 10;        // generations
  constexpr double kGain = 1e-3;       // relative, of so many
  constexpr double kFirstWidth = 0.5;  // in units of what matters: the values themselves
  const Eigen::VectorXd units = search_units(parameters, start);
  const std::vector<int> train = recordings.data().windows_of(Role::train);
  Found found;
  found.tried.push_back({start, recordings.errors(train, start)});
  CmaSearch search(Eigen::VectorXd::Zero(start.size()), kFirstWidth, 0, kSeed);
  std::vector<double> best{found.tried.front().errors.mean()};
  while (found.generations < options.iterations && !found.settled) {
    const Eigen::MatrixXd candidates = search.ask();
    Eigen::VectorXd costs(candidates.cols());
    for (Eigen::Index c = 0; c < candidates.cols(); ++c) {
      const Eigen::VectorXd theta = values_at(parameters, start, units, candidates.col(c));
      found.tried.push_back({theta, recordings.errors(train, theta)});
      costs[c] = found.tried.back().errors.mean();
      best.back() = std::min(best.back(), costs[c]);
    }
    search.tell(costs);
    ++found.generations;
    progress("searching, error " + number_text(best.back(), 4),
             static_cast<double>(found.generations) / options.iterations);
    const auto n = static_cast<int>(best.size());
    found.settled =
        n > kPatience && best.back() > (1.0 - kGain) * best[static_cast<std::size_t>(n - 1 - kPatience)];
    best.push_back(best.back());
  }
  return found;
}

/// The best set of each draw of recordings, parameters x draws.
Eigen::MatrixXd bootstrap(const std::vector<Tried>& tried, std::uint64_t seed) {
  constexpr Eigen::Index kDraws = 1000;
  const auto n = tried.front().errors.size();
  Eigen::MatrixXd errors(static_cast<Eigen::Index>(tried.size()), n);
  for (std::size_t k = 0; k < tried.size(); ++k) {
    errors.row(static_cast<Eigen::Index>(k)) = tried[k].errors.transpose();
  }
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<Eigen::Index> pick(0, n - 1);
  Eigen::MatrixXd best(tried.front().theta.size(), kDraws);
  for (Eigen::Index d = 0; d < kDraws; ++d) {
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      counts[pick(random)] += 1.0;
    }
    Eigen::Index at = 0;
    (errors * counts).minCoeff(&at);
    best.col(d) = tried[static_cast<std::size_t>(at)].theta;
  }
  return best;
}

double quantile(Eigen::VectorXd values, double share) {
  std::sort(values.data(), values.data() + values.size());
  return values[static_cast<Eigen::Index>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

FittedParameter judged(const FreeParameter& parameter, const Eigen::VectorXd& draws, double after,
                       double confidence) {
  FittedParameter fitted;
  fitted.label = parameter.label;
  fitted.unit = parameter.unit;
  fitted.after = after;
  const double mean = draws.mean();
  fitted.deviation = std::sqrt((draws.array() - mean).square().mean());
  fitted.lower = std::min(after, quantile(draws, 0.5 * (1.0 - confidence)));
  fitted.upper = std::max(after, quantile(draws, 0.5 * (1.0 + confidence)));
  return fitted;
}

void set_partner_by_draws(const std::vector<FreeParameter>& parameters, const Eigen::MatrixXd& draws,
                          Eigen::Index p, FittedParameter& fitted) {
  const Eigen::VectorXd here = draws.row(p).transpose().array() - draws.row(p).mean();
  for (Eigen::Index q = 0; q < draws.rows(); ++q) {
    const Eigen::VectorXd other = draws.row(q).transpose().array() - draws.row(q).mean();
    const double scale = here.norm() * other.norm();
    const double correlation = q != p && scale > 0.0 ? here.dot(other) / scale : 0.0;
    if (std::abs(correlation) > std::abs(fitted.correlation)) {
      fitted.correlation = correlation;
      fitted.partner = parameters[static_cast<std::size_t>(q)].label;
    }
  }
}

}  // namespace

double error_of_motion(const Predictor& predictor, const Trial& trial, const Window& window,
                       const Eigen::MatrixXd& predicted) {
  double square = 0.0;
  const Eigen::Index n = predicted.rows();
  for (Eigen::Index c = 0; c < predicted.cols(); ++c) {
    const Eigen::VectorXd measured =
        trial.measured[static_cast<std::size_t>(c)].values.segment(window.first, window.count);
    const double floor = predictor.floors()[c];
    const double at_end = predicted(n - 1, c);
    const double sum = (measured.head(n) - predicted.col(c)).squaredNorm() +
                       (measured.tail(window.count - n).array() - at_end).square().sum();
    square += sum / (floor * floor * static_cast<double>(window.count));
  }
  return std::sqrt(square / static_cast<double>(predicted.cols()));
}

Fit fit_whole(const model::Model& model, const Data& data, std::vector<FreeParameter> parameters,
              const FitOptions& options, const Progress& progress) {
  if (!data.has(Role::train)) {
    const Trial& other = data.trials.empty() ? data.tests.front() : data.trials.front();
    throw InputError({other.file, 0, "role"}, to_string(other.role), "at least one trial with role: train");
  }
  check_can_move(model, parameters);
  set_typical(model, data, parameters);
  const Eigen::VectorXd before = values_of(model, parameters);
  progress("where each recording begins", 0.0);
  Recordings recordings(model, data, parameters, before);
  const Found found = searched(recordings, parameters, before, options, progress);
  const Eigen::VectorXd& after = found.tried[best_of(found.tried)].theta;
  const Eigen::MatrixXd draws = bootstrap(found.tried, kSeed);
  Fit result;
  for (const Role role : {Role::train, Role::held_out}) {
    (role == Role::train ? result.before.train : result.before.held_out) =
        recordings.mean_error(role, before);
    (role == Role::train ? result.after.train : result.after.held_out) = recordings.mean_error(role, after);
  }
  for (Eigen::Index p = 0; p < after.size(); ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    FittedParameter fitted = judged(parameter, draws.row(p).transpose(), after[p], options.confidence);
    fitted.before = before[p];
    fitted.degrees_of_freedom = static_cast<double>(found.tried.front().errors.size() - 1);
    set_partner_by_draws(parameters, draws, p, fitted);
    add_doubts(parameter, true, options, fitted);
    result.parameters.push_back(std::move(fitted));
  }
  result.windows = static_cast<int>(found.tried.front().errors.size());
  result.iterations = found.generations;
  result.converged = found.settled;
  result.whole = true;
  return result;
}

}  // namespace plumbline::validation
