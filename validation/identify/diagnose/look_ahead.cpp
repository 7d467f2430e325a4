#include "validation/identify/diagnose/look_ahead.h"

#include <algorithm>
#include <optional>
#include <set>

#include "validation/identify/diagnose/first_of_each.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/revise.h"
#include "validation/identify/diagnose/tangents.h"

namespace plumbline::validation {
namespace {

constexpr std::size_t kPairs = 6;  // that are returned

/// The same two candidates, in whichever order.
bool is_same(const Pair& one, const Pair& other) {
  return (one.first.label() == other.first.label() && one.second.label() == other.second.label()) ||
         (one.first.label() == other.second.label() && one.second.label() == other.first.label());
}

void sort_and_join(std::vector<Pair>& pairs) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.refit.square() < b.refit.square(); });
  pairs = first_of_each(std::move(pairs), is_same, kPairs);
}

/// It explains something alone. What follows one that does not would be what follows the stage itself.
bool is_material(const Refit& refit, const Stage& stage, const Policy& policy) {
  const double kept = 1.0 - policy.material;
  return refit.square() < kept * kept * stage.estimate.predicted.scores.square();
}

/// After a single refit whatever helps it most, where it promises to come near the floor: a pair is an answer
/// only there.
void add_followers(const Tried& tried, const Refit& first, const effects::Catalogue& catalogue,
                   const Data& data, const Policy& policy, const Progress& progress,
                   std::vector<Pair>& pairs) {
  const Candidate& candidate = tried.candidates[static_cast<std::size_t>(first.candidate)];
  const auto named = [&](const std::string& what, double done) {
    progress("with " + candidate.label() + ": " + what, done);
  };
  Policy fewer = policy;
  fewer.refits = policy.seconds;
  Tried next = screen_candidates(after(first), catalogue, {candidate.label()}, data, named);
  const double near = 2.0 * policy.far * policy.far;  // of train and held-out together
  if (next.hypotheses.empty() || next.hypotheses.front().promised() > near) {
    return;
  }
  refit_candidates(data, fewer, named, next);
  for (const Refit& second : next.refits) {
    Pair pair{candidate, next.candidates[static_cast<std::size_t>(second.candidate)], second};
    pair.refit.added.insert(pair.refit.added.begin(), first.added.begin(), first.added.end());
    pair.refit.own += first.own;
    pairs.push_back(std::move(pair));
  }
}

std::optional<int> index_of(const Candidate& wanted, const std::vector<Candidate>& candidates) {
  const auto found = std::find_if(candidates.begin(), candidates.end(),
                                  [&](const Candidate& one) { return one.label() == wanted.label(); });
  return found == candidates.end() ? std::nullopt
                                   : std::optional<int>(static_cast<int>(found - candidates.begin()));
}

/// A fitted stage with one effect more than the stage it began from, as a refit of that effect.
Refit refit_of(const Stage& fitted, const Stage& before) {
  Refit refit;
  refit.extended = {fitted.model, fitted.parameters, fitted.estimate.theta};
  refit.estimate = fitted.estimate;
  refit.added = {static_cast<int>(fitted.model.effects.size()) - 1};
  refit.own = static_cast<int>(fitted.parameters.size() - before.parameters.size());
  return refit;
}

}  // namespace

Tried screen_candidates(const Stage& stage, const effects::Catalogue& catalogue,
                        const std::vector<std::string>& taken, const Data& data, const Progress& progress) {
  Tried tried;
  tried.stage = stage;
  {
    PredictorPool pool(stage.model, data);
    tried.candidates = list_candidates(pool, catalogue, stage.parameters, stage.estimate);
  }
  const auto is_taken = [&](const Candidate& candidate) {
    return std::find(taken.begin(), taken.end(), candidate.label()) != taken.end();
  };
  tried.candidates.erase(std::remove_if(tried.candidates.begin(), tried.candidates.end(), is_taken),
                         tried.candidates.end());
  tried.hypotheses = screen(stage, tried.candidates, data, progress);
  return tried;
}

void refit_candidates(const Data& data, const Policy& policy, const Progress& progress, Tried& tried) {
  tried.refits =
      refit(tried.stage, tried.candidates, tried.hypotheses, data, policy, progress, &tried.failed);
}

Tried try_candidates(const Stage& stage, const effects::Catalogue& catalogue,
                     const std::vector<std::string>& taken, const Data& data, const Policy& policy,
                     const Progress& progress) {
  Tried tried = screen_candidates(stage, catalogue, taken, data, progress);
  refit_candidates(data, policy, progress, tried);
  return tried;
}

std::vector<Pair> look_ahead(const Tried& tried, const effects::Catalogue& catalogue, const Data& data,
                             const Policy& policy, const Progress& progress) {
  std::vector<Pair> pairs;
  std::vector<Hypothesis> tangents;
  for (const Hypothesis& hypothesis : tried.hypotheses) {
    if (hypothesis.tangent) {
      tangents.push_back(hypothesis);
    }
  }
  tangents = first_lot(tried.candidates, std::move(tangents));
  progress("pairs of " + std::to_string(tangents.size()) + " linear candidates", 0.0);
  for (const PairHypothesis& promise : Tangents(tried.stage, tried.candidates, tangents, data)
                                           .pairs(static_cast<std::size_t>(policy.linear_pairs))) {
    const Candidate& first = tried.candidates[static_cast<std::size_t>(promise.first.candidate)];
    const Candidate& second = tried.candidates[static_cast<std::size_t>(promise.second.candidate)];
    progress("refitting " + first.label() + " with " + second.label(), 0.5);
    try {
      pairs.push_back({first, second, refit_pair(tried.stage, first, second, promise, data)});
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      continue;  // it cannot be integrated: no explanation of these trials
    }
  }
  for (std::size_t r = 0; r < std::min(static_cast<std::size_t>(policy.firsts), tried.refits.size()); ++r) {
    if (is_material(tried.refits[r], tried.stage, policy)) {
      add_followers(tried, tried.refits[r], catalogue, data, policy, progress, pairs);
    }
  }
  sort_and_join(pairs);
  return pairs;
}

std::vector<Refit> halves_of(const Tried& tried, const std::vector<Pair>& pairs, const Data& data,
                             const Policy& policy, const Progress& progress) {
  constexpr std::size_t kBest = 3;
  std::vector<Refit> halves;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < std::min(kBest, pairs.size()); ++i) {
    const Pair& pair = pairs[i];
    if (!is_below(policy.finished, pair.refit.estimate, data)) {
      continue;
    }
    for (const Candidate* half : {&pair.first, &pair.second}) {
      const int other = half == &pair.first ? pair.refit.added.back() : pair.refit.added.front();
      const std::optional<int> candidate = index_of(*half, tried.candidates);
      if (!candidate || !seen.insert(half->label()).second) {
        continue;
      }
      progress("refitting " + half->label() + " alone", 0.9);
      Refit alone = refit_of(fitted_anew(without_effect(after(pair.refit), other), data), tried.stage);
      alone.candidate = *candidate;
      const double kept = (1.0 - policy.material) * judged(alone.estimate, data);
      if (is_below(policy.finished, alone.estimate, data) && kept <= judged(pair.refit.estimate, data)) {
        halves.push_back(std::move(alone));
      }
    }
  }
  sort_by_error(halves);
  return halves;
}

}  // namespace plumbline::validation
