#include "validation/diagnose/confirm.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "validation/diagnose/first_of_each.h"
#include "validation/predict/carried_states.h"
#include "validation/predict/deviations.h"

namespace plumbline::validation {
namespace {

bool jumps(const model::EffectUse& use) {
  const auto* law = dynamic_cast<const effects::ForceLaw*>(use.law.get());
  return law != nullptr && law->jumps(use.numbers().data()) > 0;
}

Refit refit_one(const Stage& stage, const Candidate& candidate, const Hypothesis& hypothesis,
                const Data& data, int iterations) {
  Refit result;
  result.candidate = hypothesis.candidate;
  result.extended = extend(stage, candidate, hypothesis.start);
  result.own = static_cast<int>(result.extended.parameters.size() - stage.parameters.size());
  result.added = {static_cast<int>(result.extended.model.effects.size()) - 1};
  const Eigen::VectorXd theta = promised_theta(result.extended, hypothesis);
  // The promised values decide whether states are added, so the model must hold them before it is built.
  result.extended.model = with_values(result.extended.model, result.extended.parameters, theta);
  PredictorPool pool(result.extended.model, data);
  // In the midst of a contact the states that a straight line promises may be none that can be.
  const std::vector<Eigen::VectorXd> x0 =
      data.has_segments()
          ? carried_states(fitted_model(stage), result.extended.model, data, stage.estimate.x0)
          : hypothesis.x0;
  // The way over the windows' beginnings is for the law that is new; what was there has gone it.
  const bool by_parts = jumps(result.extended.model.effects.back());
  result.estimate = gauss_newton(pool, result.extended.parameters, theta, x0, {iterations, 5e-3, by_parts});
  result.extended.theta = result.estimate.theta;
  return result;
}

void continue_refit(Refit& refit, const Data& data, int iterations) {
  PredictorPool pool(refit.extended.model, data);
  refit.estimate = gauss_newton(pool, refit.extended.parameters, refit.estimate.theta, refit.estimate.x0,
                                {iterations, 2e-3, false});
  refit.extended.theta = refit.estimate.theta;
}

/// Squared scores from per-window squares weighted by how often each window was drawn.
Scores drawn_scores(const Data& data, const std::vector<Eigen::VectorXd>& square,
                    const std::vector<int>& times) {
  std::vector<Eigen::VectorXd> weighted = square;
  for (std::size_t w = 0; w < square.size(); ++w) {
    weighted[w] = square[w] * static_cast<double>(times[w]);
  }
  return score(data, weighted);
}

double drawn_square(const Data& data, const std::vector<Eigen::VectorXd>& square,
                    const std::vector<int>& times) {
  return drawn_scores(data, square, times).square();
}

/// How often each window is drawn: with replacement within each role's windows.
std::vector<int> draw(const Data& data, std::mt19937_64& random) {
  std::vector<int> times(data.windows.size(), 0);
  for (const Role role : {Role::train, Role::held_out}) {
    const std::vector<int> windows = data.windows_of(role);
    if (windows.empty()) {
      continue;
    }
    std::uniform_int_distribution<std::size_t> pick(0, windows.size() - 1);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      ++times[static_cast<std::size_t>(windows[pick(random)])];
    }
  }
  return times;
}

bool on_bound(const FreeParameter& parameter, double value) {
  const double reach = 1e-9 * std::max(parameter.typical, std::abs(value));  // the search stops on a bound
  return value - parameter.lower < reach || parameter.upper - value < reach;
}

/// The parameters of one effect and their fitted values.
struct OwnPart {
  std::vector<FreeParameter> parameters;
  Eigen::VectorXd theta;
};

OwnPart part_of(const Refit& refit, const Eigen::VectorXd& theta, int effect) {
  OwnPart part;
  std::vector<double> values;
  for (std::size_t p = 0; p < refit.extended.parameters.size(); ++p) {
    if (refit.extended.parameters[p].id.effect == effect) {
      part.parameters.push_back(refit.extended.parameters[p]);
      values.push_back(theta[static_cast<Eigen::Index>(p)]);
    }
  }
  part.theta = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return part;
}

/// Change of an added effect's parameters that the held-out windows alone would ask for, relative, after
/// everything has moved as far towards them as the train windows leave open.
double disagreement(const Refit& refit, int effect, const Data& data) {
  const std::vector<int> windows = data.windows_of(Role::held_out);
  const Eigen::VectorXd& theta = refit.estimate.predicted.theta;
  const OwnPart own = part_of(refit, theta, effect);
  const Eigen::Index n = own.theta.size();
  if (windows.empty() || n == 0) {
    return 0.0;
  }
  PredictorPool pool(with_values(refit.extended.model, refit.extended.parameters, theta), data);
  const Eigen::VectorXd units = search_units(own.parameters, own.theta);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
  for (const Reduced& one : reduce(pool, windows, own.parameters, own.theta, refit.estimate.x0, units)) {
    H += one.H;
    g += one.g;
  }
  // Along the best-determined direction of the law: how strong the held-out motion wants the whole law.
  Eigen::VectorXd direction(n);
  for (Eigen::Index p = 0; p < n; ++p) {
    direction[p] = to_search(own.parameters[static_cast<std::size_t>(p)].scale, own.theta[p]) / units[p];
  }
  const double curvature = direction.dot(H * direction);
  return curvature > 0.0 ? std::abs(direction.dot(g)) / curvature : 0.0;
}

/// Name of a parameter without which the law would be null and which cannot be told from its null value: play
/// without a gap, a stretch without a compliance. Then something else about the law must have helped.
std::string undecided(const Refit& refit, const Data& data) {
  constexpr double kDeviations = 2.0;
  PredictorPool pool(refit.extended.model, data);
  const std::vector<FreeParameter>& parameters = refit.extended.parameters;
  Estimate at = refit.estimate;
  at.theta = refit.estimate.predicted.theta;
  const Eigen::VectorXd deviations = precision_of(pool, data.all_windows(), parameters, at).deviations;
  const model::Model fitted = with_values(refit.extended.model, parameters, at.theta);
  for (std::size_t p = parameters.size() - static_cast<std::size_t>(refit.own); p < parameters.size(); ++p) {
    const model::EffectUse& use = fitted.effects[static_cast<std::size_t>(parameters[p].id.effect)];
    const effects::Values values = use.numbers();
    const auto own = static_cast<std::size_t>(parameters[p].id.parameter);
    const double null = use.law->declaration().parameters[own].null_value;
    effects::Values without = values;
    without[own] = null;
    const effects::Scale scale = parameters[p].scale;
    const double distance = std::abs(to_search(scale, values[own]) - to_search(scale, null));
    const double deviation =
        deviations[static_cast<Eigen::Index>(p)] / std::abs(search_slope(scale, values[own]));
    if (use.law->is_null(without.data()) && distance < kDeviations * deviation) {
      return parameters[p].label;
    }
  }
  return "";
}

/// A lone parameter of an added effect that is on its bound; empty when there is none.
std::string unphysical(const Refit& refit) {
  for (const int effect : refit.added) {
    const OwnPart own = part_of(refit, refit.estimate.predicted.theta, effect);
    if (own.parameters.size() == 1 && on_bound(own.parameters.front(), own.theta[0])) {
      return own.parameters.front().label;
    }
  }
  return "";
}

/// What `check` says of a refit, if the model can be integrated close to its values.
template <typename Check>
std::string unless_unsteady(const Check& check) {
  try {
    return check();
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return "unsteady: close to its fitted values it cannot be integrated";
  }
}

/// Nothing is left to explain by the best (`refits` is sorted).
bool at_floor(const std::vector<Refit>& refits, const DiagnoseOptions& options) {
  return !refits.empty() && refits.front().square() <= 2.0 * options.finished * options.finished;
}

/// A full refit, if it can be had.
void finish_one(Refit& one, const Candidate& candidate, const Data& data, const Progress& progress) {
  if (one.is_full || one.estimate.converged) {
    return;
  }
  progress("finishing " + candidate.label(), 0.9);
  one.is_full = true;
  Refit further = one;
  try {
    continue_refit(further, data, 16);
    one = std::move(further);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return;  // where the fit would go it cannot be integrated: it stays where it is
  }
}

/// The best so far, in full before the others are tried, where it explains nearly all: once it is at the
/// floor they need not be.
void finish_leader(const Stage& stage, std::vector<Refit>& refits, const std::vector<Candidate>& candidates,
                   const Data& data, const Progress& progress) {
  constexpr double kLeft = 0.1;
  Refit& leader = refits.front();
  if (leader.square() < kLeft * stage.estimate.predicted.scores.square()) {
    finish_one(leader, candidates[static_cast<std::size_t>(leader.candidate)], data, progress);
  }
}

/// Full refits of those that are near the best; above the floor of the first few in any case: the best so far
/// may be refused, or a law with a threshold may still be on its way.
void finish(std::vector<Refit>& refits, const std::vector<Candidate>& candidates, const Data& data,
            const DiagnoseOptions& options, const Progress& progress) {
  constexpr std::size_t kFirst = 3;
  for (std::size_t r = 0; r < refits.size(); ++r) {
    Refit& one = refits[r];
    const bool near = one.square() < 1.15 * refits.front().square() + 0.05;
    if (near || (r < kFirst && !at_floor(refits, options))) {
      finish_one(one, candidates[static_cast<std::size_t>(one.candidate)], data, progress);
    }
  }
  sort_by_error(refits);
}

/// Further starts of the two best candidates: a law with a threshold inside the motion has several minima,
/// and above the floor the right one may not have been met.
std::vector<const Hypothesis*> other_starts(const std::vector<Refit>& refits,
                                            const std::vector<Hypothesis>& hypotheses) {
  constexpr std::size_t kBest = 2;
  constexpr int kStarts = 3;
  std::vector<const Hypothesis*> others;
  for (std::size_t r = 0; r < std::min(kBest, refits.size()); ++r) {
    int met = 0;
    for (const Hypothesis& hypothesis : hypotheses) {
      if (hypothesis.candidate == refits[r].candidate && met++ > 0 && met <= 1 + kStarts) {
        others.push_back(&hypothesis);
      }
    }
  }
  return others;
}

/// Of several refits of one candidate only the first, which is the best.
void keep_best_of_each(std::vector<Refit>& refits) {
  refits = first_of_each(std::move(refits), [](const Refit& one, const Refit& other) {
    return one.candidate == other.candidate;
  });
}

}  // namespace

void sort_by_error(std::vector<Refit>& refits) {
  std::stable_sort(refits.begin(), refits.end(),
                   [](const Refit& a, const Refit& b) { return a.square() < b.square(); });
}

std::vector<Refit> refit(const Stage& stage, const std::vector<Candidate>& candidates,
                         const std::vector<Hypothesis>& hypotheses, const Data& data,
                         const DiagnoseOptions& options, const Progress& progress) {
  // Segments are short enough for a straight line: fewer candidates need a refit.
  constexpr int kRefitsOnSegments = 5;
  const bool straight = data.has_segments();
  const double kept_promise = straight ? 1.2 : 2.5;
  const int most = straight ? std::min(kRefitsOnSegments, options.refits) : options.refits;
  std::vector<const Hypothesis*> chosen;
  std::map<int, int> starts_of;
  for (const Hypothesis& hypothesis : hypotheses) {
    if (static_cast<int>(chosen.size()) >= most) {
      break;
    }
    if (starts_of[hypothesis.candidate]++ == 0) {
      chosen.push_back(&hypothesis);
    }
  }
  std::vector<Refit> refits;
  const auto add = [&](const Hypothesis& hypothesis, double done) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(hypothesis.candidate)];
    progress("refitting " + candidate.label(), done);
    try {
      refits.push_back(refit_one(stage, candidate, hypothesis, data, 4));
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      return;  // it cannot be integrated: no explanation of these trials
    }
    sort_by_error(refits);
    if (refits.size() == 2) {
      finish_leader(stage, refits, candidates, data, progress);
    }
  };
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    // Far from what another one has reached at the floor it cannot come near any more. Above the floor the
    // best so far may itself be refused, and a promise made by a straight line says little.
    if (refits.size() < 2 || !at_floor(refits, options) ||
        chosen[i]->promised() <= kept_promise * refits.front().square() + 0.3) {
      add(*chosen[i], static_cast<double>(i) / static_cast<double>(chosen.size()));
    }
  }
  finish(refits, candidates, data, options, progress);
  if (!refits.empty() && !at_floor(refits, options)) {
    for (const Hypothesis* other : other_starts(refits, hypotheses)) {
      add(*other, 0.9);
    }
    keep_best_of_each(refits);
    finish(refits, candidates, data, options, progress);
  }
  return refits;
}

Refit refit_pair(const Stage& stage, const Candidate& first, const Candidate& second,
                 const PairHypothesis& promise, const Data& data) {
  const Extended with_first = extend(stage, first, promise.first.start);
  Estimate unmoved = stage.estimate;
  unmoved.theta = with_first.theta;
  Hypothesis both = promise.second;
  both.step = promise.step;
  Refit result = refit_one({with_first.model, with_first.parameters, unmoved}, second, both, data, 8);
  const auto effect = static_cast<int>(result.extended.model.effects.size());
  result.added = {effect - 2, effect - 1};
  result.own = static_cast<int>(result.extended.parameters.size() - stage.parameters.size());
  return result;
}

Stage after(const Refit& refit) {
  return {with_values(refit.extended.model, refit.extended.parameters, refit.estimate.theta),
          refit.extended.parameters, refit.estimate};
}

std::vector<double> selected_shares(const Stage& stage, const std::vector<Refit>& refits,
                                    const std::vector<std::size_t>& contenders, const Data& data,
                                    const DiagnoseOptions& options) {
  std::mt19937_64 random(options.seed);
  std::vector<double> shares(refits.size() + 1, 0.0);
  const double keep = (1.0 - options.material) * (1.0 - options.material);
  for (int r = 0; r < options.resamples; ++r) {
    const std::vector<int> times = draw(data, random);
    double best = keep * drawn_square(data, stage.estimate.predicted.square, times);
    std::size_t winner = refits.size();
    for (const std::size_t i : contenders) {
      const double square = drawn_square(data, refits[i].estimate.predicted.square, times);
      if (square < best) {
        best = square;
        winner = i;
      }
    }
    shares[winner] += 1.0 / options.resamples;
  }
  return shares;
}

double share_better(const Refit& other, const Refit& best, const Data& data, const DiagnoseOptions& options) {
  std::mt19937_64 random(options.seed);
  double share = 0.0;
  for (int r = 0; r < options.resamples; ++r) {
    const std::vector<int> times = draw(data, random);
    if (drawn_square(data, other.estimate.predicted.square, times) <
        drawn_square(data, best.estimate.predicted.square, times)) {
      share += 1.0 / options.resamples;
    }
  }
  return share;
}

std::pair<double, double> resampled_error(const Refit& refit, Role role, const Data& data,
                                          const DiagnoseOptions& options) {
  std::mt19937_64 random(options.seed);
  std::vector<double> errors;
  for (int r = 0; r < options.resamples; ++r) {
    const Scores scores = drawn_scores(data, refit.estimate.predicted.square, draw(data, random));
    errors.push_back(role == Role::train ? scores.train : scores.held_out);
  }
  std::sort(errors.begin(), errors.end());
  const auto tail = errors.size() / 20;
  return {errors[tail], errors[errors.size() - 1 - tail]};
}

// The held-out motion may be the one that decides: at the values that serve all windows, of those that the
// train windows leave open.
std::string flaw(const Refit& refit, const Data& data) {
  const std::string bound = unphysical(refit);
  if (!bound.empty()) {
    return "unphysical: " + bound + " is at its bound";
  }
  return unless_unsteady([&]() -> std::string {
    const std::string open = undecided(refit, data);
    return open.empty() ? "" : "undecided: " + open + " cannot be told from no effect";
  });
}

std::string objection(const Stage& stage, const Refit& refit, double share, const Data& data,
                      const DiagnoseOptions& options) {
  const Scores& before = stage.estimate.predicted.scores;
  const Scores& after = refit.estimate.predicted.scores;
  const bool judged = data.has(Role::held_out);
  const double fall = judged ? 1.0 - after.held_out / before.held_out : 1.0 - after.train / before.train;
  const auto percent = [](double value) {
    return std::to_string(static_cast<int>(std::lround(100.0 * value))) + " %";
  };
  if (fall < options.material) {
    const std::string error = judged ? "held-out error" : "train error";
    return "immaterial: " + error + (fall < 0.0 ? " rises by " : " falls by only ") + percent(std::abs(fall));
  }
  if (share < options.stable) {
    return "unstable: chosen in only " + percent(share) + " of the resamples";
  }
  return unless_unsteady([&]() -> std::string {
    for (const int effect : refit.added) {
      const double apart = disagreement(refit, effect, data);
      if (apart > options.consistent) {
        return "inconsistent: the held-out motion asks for a strength that differs by " + percent(apart);
      }
    }
    return "";
  });
}

}  // namespace plumbline::validation
