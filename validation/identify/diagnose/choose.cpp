#include "validation/identify/diagnose/choose.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

#include "validation/identify/diagnose/family.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/objection.h"
#include "validation/identify/diagnose/odds.h"
#include "validation/identify/diagnose/resample.h"

namespace plumbline::validation {
namespace {

/// Error of a refit that counts for choosing: train and held-out together.
double together(const Refit& refit) { return std::sqrt(refit.square()); }

/// How much a refit takes for granted: its fitted parameters, then its laws' choices and numerical constants.
std::pair<int, int> complexity(const Refit& refit) {
  int constants = 0;
  for (const int effect : refit.added) {
    constants += refit.extended.model.effects[static_cast<std::size_t>(effect)].law->parameter_count();
  }
  return {refit.own, constants};
}

/// Single effects of one family at one place. That something of the family is there may be sure where the
/// votes are split among its members, which are then each other's rivals.
bool is_of_family(const Refit& one, const Refit& other, const TiedPlaces& places) {
  const auto effect = [](const Refit& refit) -> const model::EffectUse& {
    return refit.extended.model.effects[static_cast<std::size_t>(refit.added.front())];
  };
  return one.added.size() == 1 && other.added.size() == 1 &&
         are_of_one_family(effect(one), effect(other), places);
}

/// Better in nearly all of the resamples, and by more than the searches leave.
bool is_surely_better(const Refit& other, const Refit& than, const Data& data, const Policy& policy) {
  return other.square() < (1.0 - kRefitTolerance) * than.square() &&
         share_better(other, than, data, policy) > 1.0 - policy.fair;
}

/// Contenders that predict as well as the best of them, or nearly: a simpler law is named before them. Far
/// above the floor, where parameters make up for what else is missing, a law with fewer of them is near
/// unless the best is surely better (Breiman et al. 1984: the simplest within the error of the estimate of
/// the error), and one of the same family at the same place for longer.
std::vector<std::size_t> near_best(const std::vector<Refit>& refits,
                                   const std::vector<std::size_t>& contenders, const Data& data,
                                   const TiedPlaces& places, const Policy& policy) {
  std::vector<std::size_t> near;
  if (contenders.empty()) {
    return near;
  }
  const Refit& best = refits[contenders.front()];
  const bool is_far = !is_below(policy.far, best.estimate, data);
  for (const std::size_t i : contenders) {
    const bool is_simpler = is_far && refits[i].own < best.own;
    const bool is_contained = is_simpler && is_of_family(refits[i], best, places);
    if (together(refits[i]) < (1.0 + (is_contained ? policy.simpler_far : policy.simpler)) * together(best) ||
        (is_simpler && !is_surely_better(best, refits[i], data, policy))) {
      near.push_back(i);
    }
  }
  return near;
}

/// The refits that are left when those that cannot be named are out: a law that is refused takes no share
/// from one that can be true. Only those that would win a share or the name are looked at, until none is
/// refused.
std::vector<std::size_t> without_refused(const Stage& stage, const std::vector<Refit>& refits,
                                         const Data& data, const TiedPlaces& places, const Policy& policy,
                                         Choice& choice) {
  std::vector<std::size_t> contenders(refits.size());
  std::iota(contenders.begin(), contenders.end(), std::size_t{0});
  std::vector<bool> seen(refits.size(), false);
  for (bool all_seen = false; !all_seen;) {
    all_seen = true;
    choice.shares = selected_shares(stage, refits, contenders, data, policy);
    std::vector<std::size_t> asked = near_best(refits, contenders, data, places, policy);
    for (const std::size_t i : contenders) {
      if (choice.shares[i] > policy.fair) {
        asked.push_back(i);
      }
    }
    for (const std::size_t i : asked) {
      if (!seen[i]) {
        seen[i] = true;
        choice.objections[i] = refusal(stage, refits[i], data, policy);
        all_seen = all_seen && choice.objections[i].empty();
      }
    }
    contenders.erase(std::remove_if(contenders.begin(), contenders.end(),
                                    [&](std::size_t i) { return !choice.objections[i].empty(); }),
                     contenders.end());
  }
  return contenders;
}

/// The first of those that could be named, simplest first, unless another one is surely better: of as many
/// fitted parameters, for fewer constants are no evidence, or at the floor, where what is left is noise and
/// not the trace of something else that is missing, if the odds are for its further values.
int first_to_name(const Stage& stage, const std::vector<std::size_t>& sorted,
                  const std::vector<Refit>& refits, const std::vector<std::string>& objections,
                  const Data& data, const Policy& policy) {
  std::vector<std::size_t> open;
  std::copy_if(sorted.begin(), sorted.end(), std::back_inserter(open),
               [&](std::size_t i) { return objections[i].empty(); });
  if (open.empty()) {
    return -1;
  }
  std::size_t named = open.front();
  for (const std::size_t i : open) {
    if (!is_surely_better(refits[i], refits[named], data, policy)) {
      continue;
    }
    if (refits[i].own == refits[named].own || (is_below(policy.at_floor, refits[i].estimate, data) &&
                                               log_odds(stage, refits[i], refits[named], data) > 0.0)) {
      named = i;
    }
  }
  return static_cast<int>(named);
}

/// What these data cannot tell from the named law: of no more parameters what wins in a fair share of
/// resamples or leaves the same error; of more parameters what is surely better, if only by little, or leaves
/// nearly the same error and has a fair share of the odds.
bool is_rival(const Stage& stage, const Refit& one, const Refit& named, const Data& data,
              const Policy& policy) {
  if (one.own <= named.own) {
    return share_better(one, named, data, policy) > policy.fair ||
           one.square() < (1.0 + kRefitTolerance) * named.square();
  }
  return is_surely_better(one, named, data, policy) ||
         (together(one) < (1.0 + policy.simpler) * together(named) &&
          log_odds(stage, one, named, data) > std::log(policy.fair));
}

std::vector<std::size_t> rivals_of(const Stage& stage, std::size_t named, const std::vector<Refit>& refits,
                                   const std::vector<std::size_t>& contenders, const Data& data,
                                   const Policy& policy) {
  std::vector<std::size_t> rivals;
  std::copy_if(contenders.begin(), contenders.end(), std::back_inserter(rivals), [&](std::size_t i) {
    return i != named && is_rival(stage, refits[i], refits[named], data, policy);
  });
  return rivals;
}

}  // namespace

Choice choose(const Stage& stage, const std::vector<Refit>& refits, const Data& data, const Policy& policy) {
  Choice choice;
  if (refits.empty()) {
    return choice;
  }
  const TiedPlaces places(stage.model);
  choice.shares.assign(refits.size() + 1, 0.0);
  choice.objections.assign(refits.size(), "");
  const std::vector<std::size_t> contenders = without_refused(stage, refits, data, places, policy, choice);
  if (contenders.empty()) {
    return choice;
  }
  std::vector<std::size_t> near = near_best(refits, contenders, data, places, policy);
  for (const std::size_t i : contenders) {
    const bool is_near = std::find(near.begin(), near.end(), i) != near.end();
    if (is_near || is_of_family(refits[i], refits[contenders.front()], places)) {
      choice.share += choice.shares[i];
    }
  }
  for (const std::size_t i : contenders) {
    const bool is_near = std::find(near.begin(), near.end(), i) != near.end();
    choice.objections[i] = objection(is_near ? choice.share : choice.shares[i], policy);
  }
  std::stable_sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) {
    return complexity(refits[a]) < complexity(refits[b]);
  });
  choice.named = first_to_name(stage, near, refits, choice.objections, data, policy);
  if (choice.named >= 0) {
    choice.rivals =
        rivals_of(stage, static_cast<std::size_t>(choice.named), refits, contenders, data, policy);
  }
  return choice;
}

}  // namespace plumbline::validation
