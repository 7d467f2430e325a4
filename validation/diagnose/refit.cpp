#include "validation/diagnose/refit.h"

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "validation/diagnose/first_of_each.h"
#include "validation/diagnose/judged.h"
#include "validation/diagnose/work.h"
#include "validation/predict/carried_states.h"

namespace plumbline::validation {
namespace {

bool jumps(const model::EffectUse& use) {
  const auto* law = dynamic_cast<const effects::ForceLaw*>(use.law.get());
  return law != nullptr && law->jumps(use.numbers().data()) > 0;
}

/// How much work a refit is worth.
struct Effort {
  int iterations = 4;
  bool by_parts = true;  ///< of laws that jump: also by way of the windows' beginnings
};

/// From what the hypothesis promises, or a share of the way there.
Refit refit_from(double share, const Stage& stage, const Candidate& candidate, Hypothesis hypothesis,
                 const Data& data, const Effort& effort) {
  hypothesis.step *= share;
  if (share < 1.0) {
    hypothesis.x0 = hypothesis.x0.empty() ? hypothesis.x0 : stage.estimate.x0;
  }
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
  const bool by_parts = effort.by_parts && jumps(result.extended.model.effects.back());
  result.estimate =
      gauss_newton(pool, result.extended.parameters, theta, x0, {effort.iterations, 5e-3, by_parts});
  result.extended.theta = result.estimate.theta;
  return result;
}

/// A straight line may promise values at which the model cannot be integrated, or from which the search ends
/// above where it began: then from nearer to the start, and from the stage's own initial states. A law that
/// changes nothing at its start ends no worse than without it.
Refit refit_one(const Stage& stage, const Candidate& candidate, const Hypothesis& hypothesis,
                const Data& data, const Effort& effort) {
  constexpr double kWorse = 1.02;
  constexpr double kNear = 0.1;
  std::optional<Refit> best;
  std::string reason;
  for (const double share : {1.0, kNear}) {
    try {
      Refit one = refit_from(share, stage, candidate, hypothesis, data, effort);
      if (!best || one.estimate.cost < best->estimate.cost) {
        best = std::move(one);
      }
      if (!(best->estimate.scores.train > kWorse * stage.estimate.scores.train)) {
        break;
      }
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error& error) {
      reason = error.what();
    }
  }
  if (!best) {
    throw std::runtime_error(reason);
  }
  return *best;
}

/// Every third window of either role, and what the stage, the hypothesis and a refit have for them.
class EveryThird {
 public:
  explicit EveryThird(const Data& data) : data_(data) {
    data_.windows.clear();
    for (const Role role : {Role::train, Role::held_out}) {
      const std::vector<int> all = data.windows_of(role);
      for (std::size_t i = 0; i < all.size(); i += 3) {
        kept_.push_back(static_cast<std::size_t>(all[i]));
        data_.windows.push_back(data.windows[kept_.back()]);
      }
    }
  }
  const Data& data() const { return data_; }
  Stage of(Stage stage) const {
    Estimate& estimate = stage.estimate;
    estimate.x0 = some(estimate.x0);
    estimate.square = some(estimate.square);
    estimate.scores = score(data_, estimate.square);
    estimate.predicted.square = some(estimate.predicted.square);
    estimate.predicted.scores = score(data_, estimate.predicted.square);
    return stage;
  }
  Hypothesis of(Hypothesis hypothesis) const {
    hypothesis.x0 = some(hypothesis.x0);
    return hypothesis;
  }
  double square_of(const Refit& refit) const {
    return score(data_, some(refit.estimate.predicted.square)).square();
  }

 private:
  std::vector<Eigen::VectorXd> some(const std::vector<Eigen::VectorXd>& all) const {
    std::vector<Eigen::VectorXd> few;
    for (const std::size_t w : kept_) {
      if (!all.empty()) {
        few.push_back(all[w]);
      }
    }
    return few;
  }
  Data data_;
  std::vector<std::size_t> kept_;  // indices of the windows
};

/// A law with corners takes many times the work of all others, and another start of a law mostly ends where
/// the first did. Above the floor they are refitted on every third window first: is it better there than the
/// best so far?
bool is_better_on_some(const Stage& stage, const Candidate& candidate, const Hypothesis& hypothesis,
                       const Data& data, const Effort& effort, const Refit& best) {
  const EveryThird some(data);
  try {
    return refit_one(some.of(stage), candidate, some.of(hypothesis), some.data(), effort).square() <
           some.square_of(best);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return false;
  }
}

void continue_refit(Refit& refit, const Data& data, int iterations) {
  PredictorPool pool(refit.extended.model, data);
  refit.estimate = gauss_newton(pool, refit.extended.parameters, refit.estimate.theta, refit.estimate.x0,
                                {iterations, 2e-3, false});
  refit.extended.theta = refit.estimate.theta;
}

/// Nothing is left to explain by the best (`refits` is sorted).
bool at_floor(const std::vector<Refit>& refits, const Data& data, const Policy& policy) {
  return !refits.empty() && is_below(policy.nothing, refits.front().estimate, data);
}

/// A full refit, if it can be had.
void finish_one(Refit& one, const Candidate& candidate, const Data& data, const Policy& policy,
                const Progress& progress) {
  constexpr int kIterations = 8;  // and as many again
  constexpr double kStillFalls = 0.7;
  if (one.is_full || one.estimate.converged) {
    return;
  }
  progress("finishing " + candidate.label(), 0.9);
  one.is_full = true;
  Refit further = one;
  try {
    continue_refit(further, data, kIterations);
    // Where much else is missing the last values mean little.
    if (!further.estimate.converged &&
        (is_below(policy.far, further.estimate, data) || further.square() < kStillFalls * one.square())) {
      continue_refit(further, data, kIterations);
    }
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
                   const Data& data, const Policy& policy, const Progress& progress) {
  constexpr double kLeft = 0.1;
  Refit& leader = refits.front();
  if (leader.square() < kLeft * stage.estimate.predicted.scores.square()) {
    finish_one(leader, candidates[static_cast<std::size_t>(leader.candidate)], data, policy, progress);
  }
}

/// Full refits of those that are near the best; above the floor of the first few in any case: the best so far
/// may be refused, or a law with a threshold may still be on its way.
void finish(std::vector<Refit>& refits, const std::vector<Candidate>& candidates, const Data& data,
            const Policy& policy, const Progress& progress) {
  constexpr std::size_t kFirst = 3;
  for (std::size_t r = 0; r < refits.size(); ++r) {
    Refit& one = refits[r];
    const bool near = one.square() < (1.0 + policy.near_best) * refits.front().square() + 0.05;
    if (near || (r < kFirst && !at_floor(refits, data, policy))) {
      finish_one(one, candidates[static_cast<std::size_t>(one.candidate)], data, policy, progress);
    }
  }
  sort_by_error(refits);
}

/// An error of one of the robot's or a sensor's constants, not a force that is missing.
bool is_of_constants(const effects::Law& law) {
  return dynamic_cast<const effects::StructureLaw*>(&law) != nullptr ||
         dynamic_cast<const effects::SensorLaw*>(&law) != nullptr ||
         dynamic_cast<const effects::SwitchLaw*>(&law) != nullptr ||
         law.declaration().name == "torque_constant_error";
}

/// The first start of each candidate in the order of their promise, `most` of them. Where much is missing
/// many constants promise the same compromise: they take no more than some places.
std::vector<const Hypothesis*> most_promising(const std::vector<Candidate>& candidates,
                                              const std::vector<Hypothesis>& hypotheses, int most,
                                              int most_constants) {
  std::vector<const Hypothesis*> chosen;
  std::set<int> seen;
  int constants = 0;
  for (const Hypothesis& hypothesis : hypotheses) {
    if (static_cast<int>(chosen.size()) >= most) {
      break;
    }
    if (!seen.insert(hypothesis.candidate).second) {
      continue;
    }
    const bool is_constant = is_of_constants(*candidates[static_cast<std::size_t>(hypothesis.candidate)].law);
    constants += is_constant ? 1 : 0;
    if (!is_constant || constants <= most_constants) {
      chosen.push_back(&hypothesis);
    }
  }
  return chosen;
}

/// Has it corners, or takes it many times the work of the stage, or of what the samples could show? Then the
/// search of its many short contacts takes longer than all others together.
bool is_dear(const Candidate& candidate, const Hypothesis& hypothesis, const Stage& stage, const Data& data,
             double work_of_stage) {
  constexpr double kMany = 15.0;
  constexpr double kOfSample = 100.0;  // rate evaluations
  const Extended extended = extend(stage, candidate, hypothesis.start);
  if (jumps(extended.model.effects.back())) {
    return true;
  }
  const double work =
      work_of(with_values(extended.model, extended.parameters, promised_theta(extended, hypothesis)), data);
  return work > kMany * work_of_stage || work > kOfSample;
}

/// Far above the floor: the dear ones last. Returns how many are not.
std::size_t dear_last(std::vector<const Hypothesis*>& chosen, const std::vector<Candidate>& candidates,
                      const Stage& stage, const Data& data) {
  const double work_of_stage = work_of(fitted_model(stage), data);
  const auto dear = std::stable_partition(chosen.begin(), chosen.end(), [&](const Hypothesis* one) {
    return !is_dear(candidates[static_cast<std::size_t>(one->candidate)], *one, stage, data, work_of_stage);
  });
  return static_cast<std::size_t>(dear - chosen.begin());
}

/// Parameters that a refit of the hypothesis would fit beside the stage's.
int free_count(const Candidate& candidate, const Hypothesis& hypothesis, const Stage& stage) {
  return static_cast<int>(extend(stage, candidate, hypothesis.start).parameters.size() -
                          stage.parameters.size());
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

/// Laws of fewer fitted parameters at the place of the best refit that were not refitted: it may contain one
/// of them and owe it what it explains.
std::vector<const Hypothesis*> simpler_than(const Refit& best, const std::vector<Refit>& refits,
                                            const std::vector<Candidate>& candidates,
                                            const std::vector<Hypothesis>& hypotheses, const Stage& stage) {
  constexpr std::size_t kMost = 3;
  const Candidate& named = candidates[static_cast<std::size_t>(best.candidate)];
  std::vector<const Hypothesis*> simpler;
  std::set<int> seen;
  for (const Refit& refit : refits) {
    seen.insert(refit.candidate);
  }
  for (const Hypothesis& hypothesis : hypotheses) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(hypothesis.candidate)];
    const bool is_simpler = candidate.place == named.place && candidate.at == named.at &&
                            candidate.law->state_count() <= named.law->state_count() &&
                            free_count(candidate, hypothesis, stage) < best.own;
    if (is_simpler && simpler.size() < kMost && seen.insert(hypothesis.candidate).second) {
      simpler.push_back(&hypothesis);
    }
  }
  return simpler;
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
                         const std::vector<Hypothesis>& hypotheses, const Data& data, const Policy& policy,
                         const Progress& progress, std::vector<NotRefitted>* failed) {
  // Segments are short enough for a straight line: fewer candidates need a refit.
  const bool straight = data.has_segments();
  const double kept_promise = straight ? std::min(1.2, policy.kept_promise) : policy.kept_promise;
  const int most_refits = straight ? std::min(policy.refits_segments, policy.refits) : policy.refits;
  std::vector<const Hypothesis*> chosen =
      most_promising(candidates, hypotheses, most_refits, policy.constants);
  const bool is_far = !is_below(policy.hopeless, stage.estimate, data);
  const bool is_above = !straight && !is_below(policy.far, stage.estimate, data);
  const auto has_corners = [&](const Hypothesis& one) {
    return jumps(
        extend(stage, candidates[static_cast<std::size_t>(one.candidate)], one.start).model.effects.back());
  };
  const std::vector<const Hypothesis*> by_promise = chosen;
  if (is_above) {
    std::stable_partition(chosen.begin(), chosen.end(),
                          [&](const Hypothesis* one) { return !has_corners(*one); });
  }
  const std::size_t cheap = is_far ? dear_last(chosen, candidates, stage, data) : chosen.size();
  // What a law with corners promises decides whether its many minima are worth a search: one of the first,
  // and next to the floor or most of the error.
  constexpr std::size_t kThorough = 3;
  constexpr double kLeft = 0.25;
  const double worth = std::max(policy.far * policy.far, kLeft * stage.estimate.predicted.scores.square());
  std::vector<Refit> refits;
  const auto is_tried = [&](const Hypothesis& hypothesis) {
    return std::any_of(refits.begin(), refits.end(),
                       [&](const Refit& one) { return one.candidate == hypothesis.candidate; });
  };
  const auto add = [&](const Hypothesis& hypothesis, double done, bool thorough = true,
                       bool is_other_start = false) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(hypothesis.candidate)];
    progress("refitting " + candidate.label(), done);
    // In segments a corner is rarely met, but another start through stiff ground takes minutes, too.
    const bool is_asked_first = !refits.empty() && ((is_above && has_corners(hypothesis)) ||
                                                    ((is_above || straight) && is_other_start));
    try {
      if (is_asked_first &&
          !is_better_on_some(stage, candidate, hypothesis, data, {4, thorough}, refits.front())) {
        if (failed != nullptr && !is_tried(hypothesis)) {
          failed->push_back({hypothesis.candidate, "on every third window no better than the best so far"});
        }
        return;
      }
      refits.push_back(refit_one(stage, candidate, hypothesis, data, {4, thorough}));
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error& error) {
      if (failed != nullptr) {
        failed->push_back({hypothesis.candidate, error.what()});
      }
      return;  // it cannot be integrated: no explanation of these trials
    }
    sort_by_error(refits);
    if (refits.size() == 2) {
      finish_leader(stage, refits, candidates, data, policy, progress);
    }
  };
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const bool is_explained =
        !refits.empty() &&
        refits.front().square() < policy.explained * stage.estimate.predicted.scores.square();
    if (i >= cheap && (!policy.dear || is_explained)) {
      if (failed != nullptr) {
        failed->push_back({chosen[i]->candidate,
                           "it takes many times the work; refitted where nothing else explains much"});
      }
      continue;
    }
    // Far from what another one has reached at the floor it cannot come near any more. Above the floor the
    // best so far may itself be refused, and a promise made by a straight line says little.
    if (refits.size() < 2 || !at_floor(refits, data, policy) ||
        chosen[i]->promised() <= kept_promise * refits.front().square() + 0.3) {
      add(*chosen[i], static_cast<double>(i) / static_cast<double>(chosen.size()), false);
    }
  }
  // The long way, by the windows' beginnings, where the promise is still far better than what was reached.
  for (std::size_t i = 0; i < std::min(kThorough, by_promise.size()); ++i) {
    const Hypothesis& one = *by_promise[i];
    const bool is_open = refits.empty() || one.promised() < policy.still_better * refits.front().square();
    if (is_open && one.promised() < worth && (!is_far || policy.dear) && has_corners(one)) {
      add(one, 0.9, true);
    }
  }
  keep_best_of_each(refits);
  finish(refits, candidates, data, policy, progress);
  // Where hundreds of floors remain beside what is named, another start of a threshold decides nothing.
  if (!refits.empty() && !at_floor(refits, data, policy) && (!is_far || policy.dear)) {
    std::vector<const Hypothesis*> others = other_starts(refits, hypotheses);
    std::stable_partition(others.begin(), others.end(),
                          [&](const Hypothesis* one) { return !has_corners(*one); });
    for (std::size_t i = 0; i < others.size() && !at_floor(refits, data, policy); ++i) {
      add(*others[i], 0.9, others[i]->promised() < worth, true);
    }
    keep_best_of_each(refits);
    finish(refits, candidates, data, policy, progress);
  }
  if (!refits.empty()) {
    const std::vector<const Hypothesis*> simpler =
        simpler_than(refits.front(), refits, candidates, hypotheses, stage);
    for (const Hypothesis* one : simpler) {
      add(*one, 0.95);
    }
    if (!simpler.empty()) {
      finish(refits, candidates, data, policy, progress);
    }
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
  Refit result = refit_one({with_first.model, with_first.parameters, unmoved}, second, both, data, {8, true});
  const auto effect = static_cast<int>(result.extended.model.effects.size());
  result.added = {effect - 2, effect - 1};
  result.own = static_cast<int>(result.extended.parameters.size() - stage.parameters.size());
  return result;
}

Stage after(const Refit& refit) {
  return {with_values(refit.extended.model, refit.extended.parameters, refit.estimate.theta),
          refit.extended.parameters, refit.estimate};
}

}  // namespace plumbline::validation
