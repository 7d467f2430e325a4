#include "validation/identify/predict/estimate.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plumbline::validation {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::VectorXd values_of(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& units,
                          const double* search) {
  Eigen::VectorXd theta(units.size());
  for (Eigen::Index p = 0; p < units.size(); ++p) {
    theta[p] = from_search(parameters[static_cast<std::size_t>(p)].scale, search[p] * units[p]);
  }
  return theta;
}

/// Residuals of one window and, behind them, how far its initial state is from what the sensors show.
class WindowCost : public ceres::CostFunction {
 public:
  WindowCost(PredictorPool& pool, int window, const std::vector<FreeParameter>& parameters,
             const Eigen::VectorXd& units, const Eigen::VectorXd& fixed)
      : pool_(pool), window_(window), parameters_(parameters), units_(units), fixed_(fixed) {
    pool_.with(window_, parameters_, fixed_, [&](Predictor& predictor) {
      const Window& w = pool_.data().windows[static_cast<std::size_t>(window_)];
      expected_ = predictor.initial_state(w);
      spread_ = predictor.spread_around(expected_);
      rows_ = predictor.rows(w);
    });
    if (!parameters_.empty() && units_.size() > 0) {
      mutable_parameter_block_sizes()->push_back(static_cast<int>(units_.size()));
    }
    mutable_parameter_block_sizes()->push_back(static_cast<int>(expected_.size()));
    set_num_residuals(static_cast<int>(rows_ + expected_.size()));
  }

  const Eigen::VectorXd& expected() const { return expected_; }

  /// Everything that Evaluate() will be asked for at this point.
  void prepare(const double* search, const double* x0, bool with_jacobians) {
    residuals_.resize(num_residuals());
    to_search_.resize(num_residuals(), units_.size());
    to_x_.resize(num_residuals(), expected_.size());
    const bool free = units_.size() > 0;
    const std::array<const double*, 2> blocks = {free ? search : x0, x0};
    std::array<double*, 2> jacobians = {free ? to_search_.data() : to_x_.data(), to_x_.data()};
    fine_ = evaluate(blocks.data(), residuals_.data(), with_jacobians ? jacobians.data() : nullptr);
  }

  bool Evaluate(double const* const* /*blocks*/, double* residuals, double** jacobians) const override {
    std::copy(residuals_.begin(), residuals_.end(), residuals);
    const auto hand_over = [](const Matrix& from, double* to) {
      if (to != nullptr) {
        std::copy(from.data(), from.data() + from.size(), to);
      }
    };
    if (jacobians != nullptr) {
      const bool free = units_.size() > 0;
      hand_over(to_x_, jacobians[free ? 1 : 0]);
      if (free) {
        hand_over(to_search_, jacobians[0]);
      }
    }
    return fine_;
  }

 private:
  bool evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
    const bool free = units_.size() > 0;
    const Eigen::VectorXd theta = free ? values_of(parameters_, units_, blocks[0]) : fixed_;
    const Eigen::Map<const Eigen::VectorXd> x0(blocks[free ? 1 : 0], expected_.size());
    if (!x0.allFinite() || theta.array().isNaN().any()) {
      return false;
    }
    bool fine = true;
    try {
      pool_.with(window_, parameters_, theta,
                 [&](Predictor& predictor) { fine = fill(predictor, theta, x0, residuals, jacobians); });
    } catch (const Stopped&) {
      return false;
    } catch (const std::runtime_error&) {
      return false;  // the integrator gave up: Ceres takes a shorter step
    }
    return fine;
  }

  bool fill(Predictor& predictor, const Eigen::VectorXd& theta, const Eigen::VectorXd& x0, double* residuals,
            double** jacobians) const {
    const Window& w = pool_.data().windows[static_cast<std::size_t>(window_)];
    const bool free = units_.size() > 0;
    const Eigen::Index nx = expected_.size();
    Eigen::Map<Eigen::VectorXd> r(residuals, rows_ + nx);
    r.tail(nx) = (x0 - expected_).cwiseQuotient(spread_);
    if (jacobians == nullptr) {
      r.head(rows_) = predictor.residual(w, x0);
      return r.allFinite();
    }
    const std::vector<FreeParameter> none;
    const Linearisation lin = predictor.linearise(w, x0, free ? parameters_ : none);
    r.head(rows_) = lin.r;
    double* to_x = jacobians[free ? 1 : 0];
    if (to_x != nullptr) {
      Eigen::Map<Matrix> J(to_x, rows_ + nx, nx);
      J.topRows(rows_) = -lin.Jx;
      J.bottomRows(nx) = spread_.cwiseInverse().asDiagonal();
    }
    if (free && jacobians[0] != nullptr) {
      Eigen::Map<Matrix> J(jacobians[0], rows_ + nx, units_.size());
      J.setZero();
      J.topRows(rows_) = -lin.Jp * search_slopes(parameters_, units_, theta).asDiagonal();
    }
    return r.allFinite();
  }

  PredictorPool& pool_;
  int window_;
  const std::vector<FreeParameter>& parameters_;
  Eigen::VectorXd units_, fixed_, expected_, spread_;
  Eigen::Index rows_ = 0;
  Eigen::VectorXd residuals_;
  Matrix to_search_, to_x_;
  bool fine_ = false;
};

/// Evaluates the windows in parallel before Ceres collects them on one thread: its own threads would sum in
/// an order of chance, and an estimate could not be repeated to the last bit.
class AllWindows : public ceres::EvaluationCallback {
 public:
  explicit AllWindows(int threads) : threads_(threads) {}
  void add(WindowCost* cost, const double* search, const double* x0) {
    windows_.push_back({cost, search, x0});
  }
  void PrepareForEvaluation(bool with_jacobians, bool /*new_point*/) override {
    parallel_for(static_cast<int>(windows_.size()), threads_, [&](int i) {
      const Item& window = windows_[static_cast<std::size_t>(i)];
      window.cost->prepare(window.search, window.x0, with_jacobians);
    });
  }

 private:
  struct Item {
    WindowCost* cost;
    const double *search, *x0;
  };
  int threads_;
  std::vector<Item> windows_;
};

ceres::Solver::Options solver_options(const EstimateOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  solver.num_threads = 1;
  solver.max_num_iterations = options.iterations;
  solver.function_tolerance = options.tolerance;
  solver.logging_type = ceres::SILENT;
  solver.initial_trust_region_radius = 1e6;
  return solver;
}

void set_bounds(ceres::Problem& problem, double* block, const std::vector<FreeParameter>& parameters,
                const Eigen::VectorXd& units) {
  for (Eigen::Index p = 0; p < units.size(); ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    double a = to_search(parameter.scale, parameter.lower) / units[p];
    double b = to_search(parameter.scale, parameter.upper) / units[p];
    if (a > b) {
      std::swap(a, b);  // a reciprocal turns the order round
    }
    block[p] = std::clamp(block[p], std::isfinite(a) ? a : -1e300, std::isfinite(b) ? b : 1e300);
    if (std::isfinite(a)) {
      problem.SetParameterLowerBound(block, static_cast<int>(p), a);
    }
    if (std::isfinite(b)) {
      problem.SetParameterUpperBound(block, static_cast<int>(p), b);
    }
  }
}

/// Solves for theta (when units is not empty) and the initial states of the given windows.
ceres::Solver::Summary solve(PredictorPool& pool, const std::vector<int>& windows,
                             const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& units,
                             Eigen::VectorXd& theta, std::vector<Eigen::VectorXd>& x0,
                             const EstimateOptions& options) {
  AllWindows evaluation(pool.data().threads);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &evaluation;
  ceres::Problem problem(problem_options);
  Eigen::VectorXd search(units.size());
  for (Eigen::Index p = 0; p < units.size(); ++p) {
    search[p] = to_search(parameters[static_cast<std::size_t>(p)].scale, theta[p]) / units[p];
  }
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  std::vector<std::unique_ptr<WindowCost>> costs(windows.size());
  parallel_for(static_cast<int>(windows.size()), pool.data().threads, [&](int i) {
    costs[static_cast<std::size_t>(i)] =
        std::make_unique<WindowCost>(pool, windows[static_cast<std::size_t>(i)], parameters, units, theta);
  });
  // Ceres eliminates blocks in the order of their addresses: in one array they are in the windows' order.
  Eigen::Index all = 0;
  for (const auto& cost : costs) {
    all += cost->expected().size();
  }
  Eigen::VectorXd states(all);
  std::vector<Eigen::Index> sizes;
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const Eigen::Index nx = costs[i]->expected().size();
    const Eigen::VectorXd& given = x0[static_cast<std::size_t>(windows[i])];
    auto start = states.segment(next, nx);
    start = given.size() == nx ? given : costs[i]->expected();
    next += nx;
    sizes.push_back(nx);
    std::vector<double*> blocks;
    if (units.size() > 0) {
      blocks.push_back(search.data());
    }
    blocks.push_back(start.data());
    evaluation.add(costs[i].get(), search.data(), start.data());
    problem.AddResidualBlock(costs[i].release(), nullptr, blocks);
    order->AddElementToGroup(start.data(), 0);
  }
  if (units.size() > 0) {
    set_bounds(problem, search.data(), parameters, units);
    order->AddElementToGroup(search.data(), 1);
  }
  ceres::Solver::Options solver = solver_options(options);
  if (units.size() > 0) {
    solver.linear_solver_ordering = order;
  } else {
    solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  }
  // A step to where nothing can be predicted is taken back; the library prints all its numbers beside that.
  FLAGS_minloglevel = google::GLOG_FATAL;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (pool.data().stop != nullptr && pool.data().stop->raised) {
    throw Stopped();
  }
  next = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    x0[static_cast<std::size_t>(windows[i])] = states.segment(next, sizes[i]);
    next += sizes[i];
  }
  theta = units.size() > 0 ? values_of(parameters, units, search.data()) : theta;
  return summary;
}

}  // namespace

Eigen::VectorXd search_units(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta) {
  Eigen::VectorXd units(static_cast<Eigen::Index>(parameters.size()));
  for (Eigen::Index p = 0; p < units.size(); ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const double here = std::isfinite(theta[p]) && theta[p] != 0.0 ? std::abs(theta[p]) : 0.0;
    switch (parameter.scale) {
      case effects::Scale::logarithm:
        units[p] = 1.0;
        break;
      case effects::Scale::reciprocal:
        units[p] = 1.0 / (here > 0.0 ? here : parameter.typical);
        break;
      case effects::Scale::linear:
        units[p] = std::max(here, parameter.typical);
    }
  }
  return units;
}

Eigen::VectorXd search_slopes(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& units,
                              const Eigen::VectorXd& theta) {
  Eigen::VectorXd slopes(units.size());
  for (Eigen::Index p = 0; p < units.size(); ++p) {
    slopes[p] = search_slope(parameters[static_cast<std::size_t>(p)].scale, theta[p]) * units[p];
  }
  return slopes;
}

Eigen::MatrixXd known_correlation(const std::vector<FreeParameter>& parameters) {
  std::vector<std::string> labels;
  std::shared_ptr<const model::Correlations> together;
  for (const FreeParameter& parameter : parameters) {
    if (std::isfinite(parameter.deviation)) {
      labels.push_back(parameter.label);
      together = parameter.together ? parameter.together : together;
    }
  }
  return (together ? *together : model::Correlations{}).among(labels);
}

Prior prior(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& units,
            const Eigen::VectorXd& theta) {
  const Eigen::VectorXd slopes = search_slopes(parameters, units, theta);
  std::vector<Eigen::Index> known;
  for (Eigen::Index p = 0; p < units.size(); ++p) {
    if (std::isfinite(parameters[static_cast<std::size_t>(p)].deviation)) {
      known.push_back(p);
    }
  }
  const auto count = static_cast<Eigen::Index>(known.size());
  Eigen::VectorXd off(count);
  Eigen::VectorXd slope(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index p = known[static_cast<std::size_t>(k)];
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    off[k] = (theta[p] - parameter.mean) / parameter.deviation;
    slope[k] = slopes[p] / parameter.deviation;
  }
  const Eigen::MatrixXd information =
      known_correlation(parameters).llt().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::VectorXd pull = information * off;
  Prior all{0.0, Eigen::VectorXd::Zero(units.size()), Eigen::MatrixXd::Zero(units.size(), units.size())};
  for (Eigen::Index k = 0; k < count; ++k) {
    all.square += off[k] * pull[k];
  }
  all.g(known) = -slope.cwiseProduct(pull);
  all.H(known, known) = slope.asDiagonal() * information * slope.asDiagonal();
  return all;
}

namespace {

/// Events of each contact switch in the trial's windows.
Eigen::VectorXd event_counts(const Data& data, std::size_t t) {
  const Trial& trial = data.trials[t];
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(trial.switches.size()));
  for (const Window& window : data.windows) {
    for (std::size_t e = 0; window.trial == static_cast<int>(t) && e < window.events.size(); ++e) {
      counts[trial.contact_events[static_cast<std::size_t>(window.events[e])].record] += 1.0;
    }
  }
  return counts;
}

/// Mean squares of a trial's channels, added up, and how many channels that were. A contact switch has one
/// residual for each event.
struct SumOfSquares {
  double of_means = 0.0, channels = 0.0;
};

SumOfSquares sum_of(const Data& data, std::size_t t, const std::vector<Eigen::VectorXd>& square) {
  Eigen::VectorXd total;
  double samples = 0.0;
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    if (data.windows[w].trial == static_cast<int>(t)) {
      total = total.size() == 0 ? square[w] : Eigen::VectorXd(total + square[w]);
      samples += static_cast<double>(data.windows[w].count);
    }
  }
  if (data.trials[t].switches.empty() || total.size() == 0) {
    return {total.sum() / std::max(samples, 1.0), static_cast<double>(total.size())};
  }
  const Eigen::VectorXd events = event_counts(data, t);
  const Eigen::Index sampled = total.size() - events.size();
  SumOfSquares sum{total.head(sampled).sum() / std::max(samples, 1.0), static_cast<double>(sampled)};
  for (Eigen::Index c = 0; c < events.size(); ++c) {
    if (events[c] > 0.0) {
      sum.of_means += total[sampled + c] / events[c];
      sum.channels += 1.0;
    }
  }
  return sum;
}

}  // namespace

double readings(const Data& data, int window) {
  const Window& one = data.windows[static_cast<std::size_t>(window)];
  const Trial& trial = data.trials[static_cast<std::size_t>(one.trial)];
  return static_cast<double>(one.count) * static_cast<double>(trial.measured.size());
}

double test_error(const model::Model& model, const Data& data) {
  if (data.tests.empty()) {
    return 0.0;
  }
  const Data tests = data.of_tests();
  PredictorPool pool(model, tests);
  return estimate_states(pool).scores.test;
}

Scores score(const Data& data, const std::vector<Eigen::VectorXd>& square) {
  Scores scores;
  for (const Role role : {Role::train, Role::held_out, Role::test}) {
    // Channels are those of each trial; a channel that several trials measure counts once for each.
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t t = 0; t < data.trials.size(); ++t) {
      if (data.trials[t].role == role) {
        const SumOfSquares one = sum_of(data, t, square);
        sum += one.of_means;
        count += one.channels;
      }
    }
    double& of_role = role == Role::train      ? scores.train
                      : role == Role::held_out ? scores.held_out
                                               : scores.test;
    of_role = count > 0.0 ? std::sqrt(sum / count) : 0.0;
  }
  return scores;
}

std::vector<Eigen::VectorXd> squares(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                     const Eigen::VectorXd& theta, const std::vector<Eigen::VectorXd>& x0) {
  const Data& data = pool.data();
  std::vector<Eigen::VectorXd> square(data.windows.size());
  parallel_for(static_cast<int>(data.windows.size()), data.threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    pool.with(w, parameters, theta, [&](Predictor& predictor) {
      Eigen::VectorXd r;
      try {
        r = predictor.residual(data.windows[i], x0[i]);
      } catch (const Stopped&) {
        throw;
      } catch (const std::runtime_error&) {
        // What cannot be integrated is not predicted: no number of floors says how far off it is.
        r = Eigen::VectorXd::Constant(predictor.rows(data.windows[i]),
                                      std::numeric_limits<double>::infinity());
      }
      square[i] = predictor.squares(data.windows[i], r);
    });
  });
  return square;
}

Estimate estimate(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                  const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& start_x0,
                  const EstimateOptions& options) {
  const Data& data = pool.data();
  Estimate result;
  result.theta = start;
  result.x0 = start_x0.empty() ? std::vector<Eigen::VectorXd>(data.windows.size()) : start_x0;
  const Eigen::VectorXd units = search_units(parameters, start);
  const ceres::Solver::Summary summary =
      solve(pool, data.windows_of(Role::train), parameters, units, result.theta, result.x0, options);
  result.iterations = static_cast<int>(summary.iterations.size());
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  if (data.has(Role::held_out)) {
    solve(pool, data.windows_of(Role::held_out), parameters, Eigen::VectorXd(), result.theta, result.x0,
          options);
  }
  result.square = squares(pool, parameters, result.theta, result.x0);
  result.scores = score(data, result.square);
  return result;
}

}  // namespace plumbline::validation
