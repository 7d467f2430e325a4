#include "validation/identify/diagnose/standard_effects.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/objection.h"
#include "validation/identify/diagnose/resample.h"
#include "validation/identify/predict/deviations.h"

namespace plumbline::validation {
namespace {

bool is_one_of(const Candidate& candidate, const std::vector<std::string>& laws) {
  return std::find(laws.begin(), laws.end(), candidate.law->declaration().name) != laws.end();
}

bool is_plain_friction(const Candidate& candidate) { return is_one_of(candidate, {"viscous", "coulomb"}); }

bool is_drive_constant(const Candidate& candidate) {
  return is_one_of(candidate, {"rotor_inertia", "torque_constant_error", "torque_bias"});
}

/// Is a number of this kind at this place among the stage's parameters?
bool is_open(const Stage& stage, const Candidate& candidate) {
  return std::any_of(stage.parameters.begin(), stage.parameters.end(), [&](const FreeParameter& parameter) {
    const model::EffectUse& use = stage.model.effects[static_cast<std::size_t>(parameter.id.effect)];
    return use.at == candidate.at && use.law->declaration().name == candidate.law->declaration().name;
  });
}

/// Of the candidates those at as many places as the robot can move independently, motors first: friction at a
/// joint that moves with motors alone could not be told from theirs.
std::vector<Candidate> at_independent_places(const model::Model& model, std::vector<Candidate> candidates) {
  constexpr double kIndependent = 1e-6;
  model::Plant plant(model, {});
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.place == effects::Place::motor && b.place != effects::Place::motor;
  });
  Eigen::MatrixXd directions(plant.positions(), 0);
  std::vector<std::string> places;
  std::vector<Candidate> kept;
  for (const Candidate& candidate : candidates) {
    const bool is_known = std::find(places.begin(), places.end(), candidate.at) != places.end();
    if (!is_known) {
      Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
      Eigen::MatrixXd more(plant.positions(), directions.cols() + 1);
      for (Eigen::Index i = 0; i < more.rows(); ++i) {
        x[plant.positions() + i] = 1.0;
        more(i, directions.cols()) = plant.velocity_of(candidate.at, x.data());
        x[plant.positions() + i] = 0.0;
      }
      more.leftCols(directions.cols()) = directions;
      more.col(directions.cols()).normalize();
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> rank(more);
      rank.setThreshold(kIndependent);
      if (!more.allFinite() || rank.rank() < more.cols()) {
        continue;
      }
      directions = more;
      places.push_back(candidate.at);
    }
    kept.push_back(candidate);
  }
  return kept;
}

/// The stage with all of them at their null values, not yet fitted.
Stage with_all(const Stage& stage, const std::vector<Candidate>& candidates) {
  Stage all = stage;
  for (const Candidate& candidate : candidates) {
    const Extended extended = extend(all, candidate, candidate.law->starts(candidate.scales).front());
    all.model = extended.model;
    all.parameters = extended.parameters;
    all.estimate.theta = extended.theta;
  }
  return all;
}

Stage fitted(Stage all, const Data& data) {
  constexpr int kIterations = 12;
  PredictorPool pool(all.model, data);
  all.estimate = gauss_newton(pool, all.parameters, all.estimate.theta, all.estimate.x0,
                              {kIterations, kRefitTolerance, false});
  all.model = with_values(all.model, all.parameters, all.estimate.theta);
  return all;
}

/// Those of the last effects whose strength the data tell from nothing by two deviations, and that are not
/// where the robot cannot be beyond.
std::vector<Candidate> told(const Stage& all, const std::vector<Candidate>& candidates, const Data& data,
                            const Policy& policy) {
  PredictorPool pool(all.model, data);
  const Eigen::VectorXd deviations =
      precision_of(pool, data.windows_of(Role::train), all.parameters, all.estimate).deviations;
  const int first = static_cast<int>(all.model.effects.size() - candidates.size());
  std::vector<bool> is_told(candidates.size(), false);
  std::vector<bool> is_at_limit(candidates.size(), false);
  for (std::size_t p = 0; p < all.parameters.size(); ++p) {
    const FreeParameter& parameter = all.parameters[p];
    const auto i = static_cast<Eigen::Index>(p);
    if (parameter.id.effect >= first) {
      const auto candidate = static_cast<std::size_t>(parameter.id.effect - first);
      const double null =
          candidates[candidate].law->null_values()[static_cast<std::size_t>(parameter.id.parameter)];
      is_told[candidate] = std::abs(all.estimate.theta[i] - null) > policy.told * deviations[i];
      is_at_limit[candidate] =
          is_at_limit[candidate] || (parameter.physical && on_bound(parameter, all.estimate.theta[i]));
    }
  }
  std::vector<Candidate> kept;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (is_told[c] && !is_at_limit[c]) {
      kept.push_back(candidates[c]);
    }
  }
  return kept;
}

Refit as_refit(const Stage& stage) {
  Refit refit;
  refit.extended = {stage.model, stage.parameters, stage.estimate.theta};
  refit.estimate = stage.estimate;
  return refit;
}

/// All of them, and without those that the data do not tell, until all are told.
std::optional<Group> fitted_group(const Tried& tried, std::vector<Candidate> candidates, const Data& data,
                                  const Policy& policy) {
  constexpr std::size_t kLeast = 2;
  while (candidates.size() >= kLeast) {
    Stage all = fitted(with_all(tried.stage, candidates), data);
    std::vector<Candidate> kept = told(all, candidates, data, policy);
    if (kept.size() == candidates.size()) {
      return Group{std::move(kept), std::move(all), 0.0};
    }
    candidates = std::move(kept);
  }
  return {};
}

/// Friction alone, or with the drives' constants where these are worth it.
std::optional<Group> best_group(const Tried& tried, const Data& data, const Policy& policy) {
  std::vector<Candidate> candidates;
  std::copy_if(tried.candidates.begin(), tried.candidates.end(), std::back_inserter(candidates),
               [&](const Candidate& one) { return is_plain_friction(one) && !is_open(tried.stage, one); });
  candidates = at_independent_places(tried.stage.model, std::move(candidates));
  std::optional<Group> friction;
  if (!candidates.empty()) {
    friction = fitted_group(tried, candidates, data, policy);
  }
  const std::size_t before = candidates.size();
  std::copy_if(tried.candidates.begin(), tried.candidates.end(), std::back_inserter(candidates),
               [&](const Candidate& one) { return is_drive_constant(one) && !is_open(tried.stage, one); });
  if (candidates.size() == before ||
      (friction && is_below(policy.finished, friction->stage.estimate, data))) {
    return friction;
  }
  std::optional<Group> drives = fitted_group(tried, candidates, data, policy);
  if (!drives || !friction) {
    return drives ? std::move(drives) : std::move(friction);
  }
  const Refit one = as_refit(drives->stage);
  const Refit other = as_refit(friction->stage);
  const bool is_better =
      judged(one.estimate, data) < (1.0 - policy.material) * judged(other.estimate, data) &&
      share_better(one, other, data, policy) > policy.stable;
  return is_better ? std::move(drives) : std::move(friction);
}

/// Does it leave so little that no single effect needs to be refitted beside it?
bool is_ahead_of_promises(const Refit& group, const Tried& tried) {
  double promised = tried.stage.estimate.predicted.scores.square();
  for (const Hypothesis& hypothesis : tried.hypotheses) {
    promised = std::min(promised, hypothesis.promised());
  }
  return group.square() < promised;
}

}  // namespace

std::optional<Group> standard_effects(const Tried& tried, const Data& data, const Policy& policy,
                                      const Progress& progress) {
  constexpr std::size_t kLeast = 2;
  const auto count =
      std::count_if(tried.candidates.begin(), tried.candidates.end(), [&](const Candidate& one) {
        return (is_plain_friction(one) || is_drive_constant(one)) && !is_open(tried.stage, one);
      });
  const bool is_answered =
      !tried.refits.empty() && is_below(policy.finished, tried.refits.front().estimate, data);
  if (static_cast<std::size_t>(count) < kLeast || is_answered) {
    return {};
  }
  progress("friction at every joint, constants of every drive", 0.97);
  try {
    std::optional<Group> group = best_group(tried, data, policy);
    if (!group) {
      return {};
    }
    const Refit one = as_refit(group->stage);
    const Refit best = tried.refits.empty() ? as_refit(tried.stage) : tried.refits.front();
    group->share = share_better(one, best, data, policy);
    const bool is_better =
        judged(one.estimate, data) < (1.0 - policy.material) * judged(best.estimate, data) &&
        judged(one.estimate, data) < (1.0 - policy.material) * judged(tried.stage.estimate, data);
    const bool is_ahead = !tried.refits.empty() || is_ahead_of_promises(one, tried);
    return is_better && is_ahead && group->share > policy.stable ? group : std::nullopt;
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return {};  // with so much friction it cannot be integrated
  }
}

}  // namespace plumbline::validation
