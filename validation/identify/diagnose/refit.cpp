#include "validation/identify/diagnose/refit.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "validation/identify/diagnose/family.h"
#include "validation/identify/diagnose/first_of_each.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/race.h"
#include "validation/identify/diagnose/refit_one.h"
#include "validation/identify/predict/work_ahead.h"

namespace plumbline::validation {
namespace {

/// Nothing is left to explain by the best (`refits` is sorted).
bool at_floor(const std::vector<Refit>& refits, const Data& data, const Policy& policy) {
  return !refits.empty() && is_below(policy.at_floor, refits.front().estimate, data);
}

/// The best so far, in full before the others are tried, where it explains nearly all: once it is at the
/// floor they need not be.
void finish_leader(const Stage& stage, std::vector<Refit>& refits, const std::vector<Candidate>& candidates,
                   const Data& data, const Policy& policy, const Progress& progress) {
  constexpr double kLeft = 0.1;
  Refit& leader = refits.front();
  if (leader.square() < kLeft * stage.estimate.predicted.scores.square()) {
    finish_one(leader, stage.estimate.predicted.scores.square(),
               candidates[static_cast<std::size_t>(leader.candidate)], data, policy, progress);
  }
}

/// A law of fewer parameters and of the family of one that leads at its place: a few steps may have led it
/// nowhere, or how a friction fades towards standstill is fitted in the full refit alone, and it is as good
/// then.
bool is_simpler_of_family(const Refit& one, const Refit& leader, const std::vector<Candidate>& candidates) {
  const Candidate& simple = candidates[static_cast<std::size_t>(one.candidate)];
  const Candidate& leading = candidates[static_cast<std::size_t>(leader.candidate)];
  return one.own < leader.own && simple.at == leading.at && are_of_one_family(*simple.law, *leading.law);
}

/// Those that satisfy the test, in full, each by one of the ranks where there are several.
void finish_ahead(const std::vector<Refit>& refits, double square_before,
                  const std::vector<Candidate>& candidates, const Data& data, const Policy& policy,
                  const std::function<bool(std::size_t)>& is_wanted) {
  std::vector<Ahead> pieces;
  for (std::size_t r = 0; r < refits.size(); ++r) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(refits[r].candidate)];
    if (!refits[r].is_full && is_wanted(r)) {
      pieces.push_back({"finishing " + candidate.label(), [&, r] {
                          Refit copy = refits[r];
                          finish_one(copy, square_before, candidate, data, policy,
                                     [](const std::string&, double) {});
                        }});
    }
  }
  work_ahead(data, pieces);
}

/// Full refits of those that are near the best, and of simpler laws of its family in its place; above the
/// floor of the first few in any case: the best so far may be refused, or a law with a threshold may still be
/// on its way.
void finish(std::vector<Refit>& refits, double square_before, const std::vector<Candidate>& candidates,
            const Data& data, const Policy& policy, const Progress& progress) {
  constexpr std::size_t kFirst = 3;
  const auto is_wanted = [&](std::size_t r) {
    const bool near = refits[r].square() < (1.0 + policy.near_best) * refits.front().square() + 0.05;
    return near || is_simpler_of_family(refits[r], refits.front(), candidates) ||
           (r < kFirst && !at_floor(refits, data, policy));
  };
  finish_ahead(refits, square_before, candidates, data, policy, is_wanted);
  for (std::size_t r = 0; r < refits.size(); ++r) {
    Refit& one = refits[r];
    if (is_wanted(r)) {
      finish_one(one, square_before, candidates[static_cast<std::size_t>(one.candidate)], data, policy,
                 progress);
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

/// The refits of one round, the best first.
class Round {
 public:
  Round(const Stage& stage, const std::vector<Candidate>& candidates,
        const std::vector<Hypothesis>& hypotheses, const Data& data, const Policy& policy,
        const Progress& progress, std::vector<NotRefitted>* failed)
      : stage_(stage),
        candidates_(candidates),
        hypotheses_(hypotheses),
        data_(data),
        policy_(policy),
        progress_(progress),
        failed_(failed),
        straight_(data.has_segments()),
        is_far_(!is_below(policy.hopeless, stage.estimate, data)),
        is_above_(!straight_ && !is_below(policy.far, stage.estimate, data)),
        worth_(std::max(policy.far * policy.far, kLeft * stage.estimate.predicted.scores.square())) {}

  std::vector<Refit> run() {
    // Segments are short enough for a straight line: fewer candidates need a refit.
    const int places = straight_ ? std::min(policy_.refits_segments, policy_.refits) : policy_.refits;
    const std::vector<const Hypothesis*> chosen =
        most_promising(candidates_, hypotheses_, places, policy_.constants);
    by_promise(chosen);
    if (is_above_ && !is_answered()) {
      by_promise(race(stage_, candidates_, entrants(chosen), data_, progress_));
    }
    the_long_way(chosen);
    keep_and_finish();
    further_starts();
    simpler_laws();
    return std::move(refits_);
  }

 private:
  // What a law with corners promises decides whether its many minima are worth a search: one of the first,
  // and next to the floor or most of the error.
  static constexpr std::size_t kThorough = 3;
  static constexpr double kLeft = 0.25;

  void by_promise(std::vector<const Hypothesis*> chosen) {
    const std::size_t smooth = is_above_ || is_far_ ? corners_last(chosen) : chosen.size();
    const std::size_t cheap = is_far_ ? smooth : chosen.size();
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (i >= cheap && (!policy_.dear || is_explained())) {
        report(*chosen[i], "it takes many times the work; refitted where nothing else explains much");
      } else if (may_come_near(*chosen[i])) {
        refit_ahead(chosen, i, cheap);
        add(*chosen[i], static_cast<double>(i) / static_cast<double>(chosen.size()), false);
      }
    }
  }

  /// Where a straight line says little, its order does, too: the candidates that come next in it.
  std::vector<const Hypothesis*> entrants(const std::vector<const Hypothesis*>& done) const {
    constexpr int kTimes = 3;  // as many as have been refitted, with those
    std::vector<const Hypothesis*> next =
        most_promising(candidates_, hypotheses_, kTimes * policy_.refits, kTimes * policy_.constants);
    next.erase(std::remove_if(next.begin(), next.end(),
                              [&](const Hypothesis* one) {
                                return std::find(done.begin(), done.end(), one) != done.end() ||
                                       has_corners(*one);
                              }),
               next.end());
    return next;
  }

  /// The next ones that would be refitted as it stands now, one for each rank. Some may turn out not to be
  /// needed: with one rank none is done ahead.
  void refit_ahead(const std::vector<const Hypothesis*>& chosen, std::size_t from, std::size_t cheap) {
    const auto ranks = static_cast<std::size_t>(ranks_of(data_));
    if (from < ahead_ || ranks == 1) {
      return;
    }
    std::vector<Ahead> pieces;
    std::size_t i = from;
    for (; i < chosen.size() && pieces.size() < ranks; ++i) {
      const Hypothesis& one = *chosen[i];
      if ((i >= cheap && !policy_.dear) || !may_come_near(one)) {
        continue;
      }
      const Candidate& candidate = candidates_[static_cast<std::size_t>(one.candidate)];
      // Laws with corners are held against the best so far on some windows first.
      const bool is_asked_first = is_above_ && has_corners(one) && !refits_.empty();
      pieces.push_back({"refitting " + candidate.label(), [this, &one, &candidate, is_asked_first] {
                          if (!is_asked_first ||
                              is_better_on_some(stage_, candidate, one, data_, {4, false}, refits_.front())) {
                            refit_one(stage_, candidate, one, data_, {4, false});
                          }
                        }});
    }
    ahead_ = i;
    work_ahead(data_, pieces);
  }

  /// By the windows' beginnings, where the promise is still far better than what was reached.
  void the_long_way(const std::vector<const Hypothesis*>& chosen) {
    for (std::size_t i = 0; i < std::min(kThorough, chosen.size()); ++i) {
      const Hypothesis& one = *chosen[i];
      const bool is_open =
          refits_.empty() || one.promised() < policy_.still_better * refits_.front().square();
      if (is_open && one.promised() < worth_ && (!is_far_ || policy_.dear) && has_corners(one)) {
        add(one, 0.9, true);
      }
    }
  }

  /// Where hundreds of floors remain beside what is named, another start of a threshold decides nothing.
  void further_starts() {
    if (refits_.empty() || is_at_floor() || (is_far_ && !policy_.dear)) {
      return;
    }
    std::vector<const Hypothesis*> others = other_starts(refits_, hypotheses_);
    corners_last(others);
    for (std::size_t i = 0; i < others.size() && !is_at_floor(); ++i) {
      add(*others[i], 0.9, others[i]->promised() < worth_, true);
    }
    keep_and_finish();
  }

  void simpler_laws() {
    if (refits_.empty()) {
      return;
    }
    const std::vector<const Hypothesis*> simpler =
        simpler_than(refits_.front(), refits_, candidates_, hypotheses_, stage_);
    for (const Hypothesis* one : simpler) {
      add(*one, 0.95);
    }
    if (!simpler.empty()) {
      finish(refits_, stage_.estimate.predicted.scores.square(), candidates_, data_, policy_, progress_);
    }
  }

  void add(const Hypothesis& hypothesis, double done, bool thorough = true, bool is_other_start = false) {
    const Candidate& candidate = candidates_[static_cast<std::size_t>(hypothesis.candidate)];
    progress_("refitting " + candidate.label(), done);
    // In segments a corner is rarely met, but another start through stiff ground takes minutes, too.
    const bool is_asked_first = !refits_.empty() && ((is_above_ && has_corners(hypothesis)) ||
                                                     ((is_above_ || straight_) && is_other_start));
    try {
      if (is_asked_first &&
          !is_better_on_some(stage_, candidate, hypothesis, data_, {4, thorough}, refits_.front())) {
        if (!is_tried(hypothesis)) {
          report(hypothesis, "on every third window no better than the best so far");
        }
        return;
      }
      refits_.push_back(refit_one(stage_, candidate, hypothesis, data_, {4, thorough}));
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error& error) {
      report(hypothesis, error.what());  // it cannot be integrated: no explanation of these trials
      return;
    }
    sort_by_error(refits_);
    if (refits_.size() == 2) {
      finish_leader(stage_, refits_, candidates_, data_, policy_, progress_);
    }
  }

  void keep_and_finish() {
    keep_best_of_each(refits_);
    finish(refits_, stage_.estimate.predicted.scores.square(), candidates_, data_, policy_, progress_);
  }
  void report(const Hypothesis& hypothesis, const std::string& reason) {
    if (failed_ != nullptr) {
      failed_->push_back({hypothesis.candidate, reason});
    }
  }
  bool has_corners(const Hypothesis& one) const {
    return jumps(
        extend(stage_, candidates_[static_cast<std::size_t>(one.candidate)], one.start).model.effects.back());
  }
  /// The search of their many short contacts takes longer than all others together. Returns how many have
  /// none.
  std::size_t corners_last(std::vector<const Hypothesis*>& some) const {
    const auto first = std::stable_partition(some.begin(), some.end(),
                                             [&](const Hypothesis* one) { return !has_corners(*one); });
    return static_cast<std::size_t>(first - some.begin());
  }
  bool is_tried(const Hypothesis& hypothesis) const {
    return std::any_of(refits_.begin(), refits_.end(),
                       [&](const Refit& one) { return one.candidate == hypothesis.candidate; });
  }
  bool is_at_floor() const { return at_floor(refits_, data_, policy_); }
  /// Is the best so far an answer? The model's own numbers, as they are stated, may leave the rest.
  bool is_answered() const {
    return !refits_.empty() && is_below(policy_.finished, refits_.front().estimate, data_);
  }
  bool is_explained() const {
    return !refits_.empty() &&
           refits_.front().square() < policy_.explained * stage_.estimate.predicted.scores.square();
  }
  /// Far from what another one has reached next to the floor it cannot come near any more. Above it the best
  /// so far may itself be refused, and a promise made by a straight line says little.
  bool may_come_near(const Hypothesis& one) const {
    const double kept_promise = straight_ ? std::min(1.2, policy_.kept_promise) : policy_.kept_promise;
    return refits_.size() < 2 || !is_answered() ||
           one.promised() <= kept_promise * refits_.front().square() + 0.3;
  }

  const Stage& stage_;
  const std::vector<Candidate>& candidates_;
  const std::vector<Hypothesis>& hypotheses_;
  const Data& data_;
  const Policy& policy_;
  const Progress& progress_;
  std::vector<NotRefitted>* failed_;
  bool straight_, is_far_, is_above_;
  double worth_;
  std::size_t ahead_ = 0;  // of the chosen ones, refitted ahead
  std::vector<Refit> refits_;
};

}  // namespace

void sort_by_error(std::vector<Refit>& refits) {
  std::stable_sort(refits.begin(), refits.end(),
                   [](const Refit& a, const Refit& b) { return a.square() < b.square(); });
}

std::vector<Refit> refit(const Stage& stage, const std::vector<Candidate>& candidates,
                         const std::vector<Hypothesis>& hypotheses, const Data& data, const Policy& policy,
                         const Progress& progress, std::vector<NotRefitted>* failed) {
  return Round(stage, candidates, hypotheses, data, policy, progress, failed).run();
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
