#include "validation/identify/diagnose/tangents.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include "validation/identify/diagnose/first_of_each.h"
#include "validation/identify/predict/spread.h"

namespace plumbline::validation {
namespace {

/// Of a law's parameters those that, at the strength where the law matters as much as the driving force, move
/// the prediction by a noticeable share of the floor. The others are numerical noise, and left where they
/// are.
std::vector<Eigen::Index> noticeable(const Sum& train, const std::vector<Eigen::Index>& own) {
  constexpr double kShareOfFloor = 0.03;
  std::vector<Eigen::Index> chosen;
  for (const Eigen::Index i : own) {
    if (std::isfinite(train.H(i, i)) && train.H(i, i) > kShareOfFloor * kShareOfFloor * train.samples) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

/// Normal equations of all unknowns but the first `count`, which have moved as the others ask.
struct Remaining {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
};

Remaining without_stage(const Sum& all, const Prior& known, Eigen::Index count) {
  const Eigen::Index rest = all.g.size() - count;
  Remaining left{all.H.bottomRightCorner(rest, rest), all.g.tail(rest)};
  if (count > 0) {
    Eigen::MatrixXd own = all.H.topLeftCorner(count, count);
    own += known.H.topLeftCorner(count, count);
    own.diagonal().array() += 1e-9 * own.diagonal().maxCoeff();
    const Eigen::LDLT<Eigen::MatrixXd> first(own);
    const Eigen::MatrixXd cross = all.H.bottomLeftCorner(rest, count);
    left.H.noalias() -= cross * first.solve(cross.transpose());
    left.g.noalias() -= cross * first.solve(all.g.head(count) + known.g.head(count));
  }
  return left;
}

/// What a free step of the chosen unknowns takes off the cost.
double gain(const Remaining& left, const std::vector<Eigen::Index>& chosen) {
  const auto n = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd H(n, n);
  Eigen::VectorXd g(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    g[a] = left.g[chosen[static_cast<std::size_t>(a)]];
    for (Eigen::Index b = 0; b < n; ++b) {
      H(a, b) = left.H(chosen[static_cast<std::size_t>(a)], chosen[static_cast<std::size_t>(b)]);
    }
  }
  H.diagonal() *= 1.0 + 1e-6;  // two laws that are one here have no more to give than either
  return g.dot(H.ldlt().solve(g));
}

/// A window that says nothing for or against any step: its error stays what it is.
Reduced silent(const Estimate& stage, std::size_t window, Eigen::Index parameters) {
  Reduced one;
  one.square = stage.square[window];
  one.raw_sse = one.sse = one.square.sum();
  one.H = Eigen::MatrixXd::Zero(parameters, parameters);
  one.g = Eigen::VectorXd::Zero(parameters);
  one.x_shift = Eigen::VectorXd::Zero(stage.x0[window].size());
  one.x_slope = Eigen::MatrixXd::Zero(one.x_shift.size(), parameters);
  return one;
}

/// Linearised where the stage is. A wrong model may follow a window so badly that the smallest difference
/// decides whether it can be integrated: what cannot be is silent.
std::vector<Reduced> linearise(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                               const Eigen::VectorXd& theta, const Estimate& stage,
                               const Eigen::VectorXd& units) {
  const Data& data = pool.data();
  std::vector<Reduced> all(data.windows.size());
  const auto work = [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    try {
      all[i] = reduce(pool, {w}, parameters, theta, stage.x0, units).front();
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      all[i] = silent(stage, i, units.size());
    }
  };
  for_each_item(data, static_cast<int>(all.size()),
                spread_of("linearising a window", pool.model(), parameters.size(), work, all));
  return all;
}

/// Of one linearisation. Sums over a window's rows cost as much as its slopes at about so many (a quadruped's
/// quarter second: 2,600 rows, 46 states).
constexpr std::size_t kMostColumns = 256;

std::size_t most_columns_of(const Candidate& candidate) {
  return candidate.law->declaration().parameters.size();
}

/// Behind the last of the hypotheses from `first` on that one linearisation holds; at least one.
std::size_t end_of_lot(const std::vector<Candidate>& candidates, const std::vector<Hypothesis>& hypotheses,
                       std::size_t first) {
  std::size_t columns = 0;
  std::size_t end = first;
  for (; end < hypotheses.size(); ++end) {
    columns += most_columns_of(candidates[static_cast<std::size_t>(hypotheses[end].candidate)]);
    if (columns > kMostColumns && end > first) {
      break;
    }
  }
  return end;
}

/// The same two candidates, in whichever order and from whatever starts.
bool is_same_pair(const PairHypothesis& one, const PairHypothesis& other) {
  const auto first = std::minmax(one.first.candidate, one.second.candidate);
  return first == std::minmax(other.first.candidate, other.second.candidate);
}

}  // namespace

bool has_tangent(const Candidate& candidate, const effects::Values& start) {
  return candidate.place != effects::Place::ratio && candidate.law->state_count() == 0 &&
         candidate.law->is_null(start.data());
}

std::vector<Hypothesis> promises_of(const Stage& stage, const std::vector<Candidate>& candidates,
                                    const std::vector<Hypothesis>& hypotheses, const Data& data) {
  std::vector<Hypothesis> found;
  for (std::size_t first = 0; first < hypotheses.size();) {
    const std::size_t end = end_of_lot(candidates, hypotheses, first);
    const std::vector<Hypothesis> lot(hypotheses.begin() + static_cast<std::ptrdiff_t>(first),
                                      hypotheses.begin() + static_cast<std::ptrdiff_t>(end));
    for (Hypothesis& one : Tangents(stage, candidates, lot, data).promises()) {
      found.push_back(std::move(one));
    }
    first = end;
  }
  return found;
}

std::vector<Hypothesis> first_lot(const std::vector<Candidate>& candidates,
                                  std::vector<Hypothesis> hypotheses) {
  std::set<int> seen;
  std::vector<Hypothesis> firsts;
  std::vector<Hypothesis> others;
  for (Hypothesis& one : hypotheses) {
    (seen.insert(one.candidate).second ? firsts : others).push_back(std::move(one));
  }
  std::move(others.begin(), others.end(), std::back_inserter(firsts));
  firsts.resize(end_of_lot(candidates, firsts, 0));
  return firsts;
}

Tangents::Tangents(const Stage& stage, const std::vector<Candidate>& candidates,
                   const std::vector<Hypothesis>& hypotheses, const Data& data)
    : stage_(stage), hypotheses_(hypotheses), threads_(data.threads), own_(hypotheses.size()) {
  model::Model model = stage.model;
  std::vector<FreeParameter> parameters = stage.parameters;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(hypotheses[h].candidate)];
    model.effects.push_back(make_use(candidate, hypotheses[h].start));
    for (FreeParameter& parameter :
         searched_parameters_of(model, candidate, static_cast<int>(model.effects.size()) - 1)) {
      own_[h].push_back(static_cast<Eigen::Index>(parameters.size()));
      parameters.push_back(std::move(parameter));
    }
  }
  Eigen::VectorXd theta = values_of(model, parameters);
  theta.head(stage.estimate.theta.size()) = stage.estimate.theta;
  const Eigen::VectorXd units = search_units(parameters, theta);
  PredictorPool pool(model, data);
  reduced_ = linearise(pool, parameters, theta, stage.estimate, units);
  problem_ = linear_problem(data, data.all_windows(), reduced_, parameters, theta, units);
  for (const std::vector<Eigen::Index>& own : own_) {
    moving_.push_back(noticeable(problem_.train, own));
  }
}

Tangents::Solution Tangents::solve(const std::vector<std::size_t>& some) const {
  Solution solution;
  for (std::size_t p = 0; p < stage_.parameters.size(); ++p) {
    solution.chosen.push_back(static_cast<Eigen::Index>(p));
  }
  for (const std::size_t h : some) {
    solution.chosen.insert(solution.chosen.end(), moving_[h].begin(), moving_[h].end());
  }
  solution.promise = promise_of(problem_, solution.chosen);
  return solution;
}

std::vector<Eigen::VectorXd> Tangents::states_after(const Solution& solution) const {
  std::vector<Eigen::VectorXd> states = stage_.estimate.x0;
  for (std::size_t w = 0; w < states.size(); ++w) {
    states[w] += reduced_[w].x_shift;
    for (std::size_t a = 0; a < solution.chosen.size(); ++a) {
      states[w] -=
          reduced_[w].x_slope.col(solution.chosen[a]) * solution.promise.step[static_cast<Eigen::Index>(a)];
    }
  }
  return states;
}

// The chosen columns are the stage's and some of each hypothesis'; the others stay where they are.
Eigen::VectorXd Tangents::full_step(const Solution& solution, const std::vector<std::size_t>& some) const {
  std::vector<Eigen::Index> columns;
  for (std::size_t p = 0; p < stage_.parameters.size(); ++p) {
    columns.push_back(static_cast<Eigen::Index>(p));
  }
  for (const std::size_t h : some) {
    columns.insert(columns.end(), own_[h].begin(), own_[h].end());
  }
  Eigen::VectorXd step = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t a = 0; a < solution.chosen.size(); ++a) {
    const auto at = std::find(columns.begin(), columns.end(), solution.chosen[a]) - columns.begin();
    step[at] = solution.promise.step[static_cast<Eigen::Index>(a)];
  }
  return step;
}

Hypothesis Tangents::promised(std::size_t h) const {
  const Solution solution = solve({h});
  Hypothesis hypothesis = hypotheses_[h];
  hypothesis.promised_train = solution.promise.train;
  hypothesis.promised_held_out = solution.promise.held_out;
  hypothesis.x0 = states_after(solution);
  hypothesis.step = full_step(solution, {h});
  return hypothesis;
}

std::vector<Hypothesis> Tangents::promises() const {
  std::vector<std::size_t> those;
  for (std::size_t h = 0; h < hypotheses_.size(); ++h) {
    if (!moving_[h].empty()) {
      those.push_back(h);
    }
  }
  std::vector<Hypothesis> found(those.size());
  parallel_for(static_cast<int>(those.size()), threads_, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    found[at] = promised(those[at]);
  });
  return found;
}

// Without bounds, which is quick: enough to leave out what has no prospect.
std::vector<std::pair<std::size_t, std::size_t>> Tangents::shortlist(std::size_t most) const {
  const auto count = static_cast<Eigen::Index>(stage_.parameters.size());
  const Sum all{problem_.train.H + problem_.held_out.H, problem_.train.g + problem_.held_out.g};
  const Remaining left = without_stage(all, problem_.known, count);
  std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> rated;
  for (std::size_t a = 0; a < hypotheses_.size(); ++a) {
    for (std::size_t b = a + 1; b < hypotheses_.size(); ++b) {
      if (moving_[a].empty() || moving_[b].empty() || hypotheses_[a].candidate == hypotheses_[b].candidate) {
        continue;
      }
      std::vector<Eigen::Index> chosen = moving_[a];
      chosen.insert(chosen.end(), moving_[b].begin(), moving_[b].end());
      for (Eigen::Index& column : chosen) {
        column -= count;
      }
      rated.push_back({-gain(left, chosen), {a, b}});
    }
  }
  const std::size_t kept = std::min(most, rated.size());
  std::partial_sort(rated.begin(), rated.begin() + static_cast<std::ptrdiff_t>(kept), rated.end());
  std::vector<std::pair<std::size_t, std::size_t>> best;
  for (std::size_t i = 0; i < kept; ++i) {
    best.push_back(rated[i].second);
  }
  return best;
}

std::vector<PairHypothesis> Tangents::pairs(std::size_t most) const {
  constexpr std::size_t kShortlist = 200;
  std::vector<PairHypothesis> found;
  for (const auto& [a, b] : shortlist(kShortlist)) {
    const Solution solution = solve({a, b});
    PairHypothesis pair{hypotheses_[a], hypotheses_[b], solution.promise.train, solution.promise.held_out,
                        full_step(solution, {a, b})};
    pair.second.x0 = states_after(solution);
    found.push_back(std::move(pair));
  }
  std::stable_sort(found.begin(), found.end(), [](const PairHypothesis& one, const PairHypothesis& other) {
    return one.promised() < other.promised();
  });
  return first_of_each(std::move(found), is_same_pair, most);
}

}  // namespace plumbline::validation
