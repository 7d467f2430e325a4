#include "validation/identify/diagnose/pair_step.h"

#include <algorithm>

#include "validation/identify/diagnose/accept.h"
#include "validation/identify/diagnose/findings.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/revise.h"

namespace plumbline::validation {
namespace {

/// One effect that leaves nothing alone, found beside another.
bool accept_half(const Tried& first, const std::vector<Pair>& pairs, const Data& data, const Policy& policy,
                 const Progress& progress, Diagnosis& diagnosis) {
  Tried halves = first;
  halves.refits = halves_of(first, pairs, data, policy, progress);
  const Choice choice = choose(first.stage, halves.refits, data, policy);
  if (choice.named < 0) {
    return false;
  }
  diagnosis.pairs.clear();
  drop_accepted(diagnosis);
  accept(halves, choice, data, diagnosis);
  return true;
}

Choice choose_pair(const Tried& first, const std::vector<Pair>& pairs, const Data& data,
                   const Policy& policy) {
  std::vector<Refit> refits;
  refits.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    refits.push_back(pair.refit);
  }
  return choose(first.stage, refits, data, policy);
}

/// Of pairs of which none is named, the one that predicts better than all there is so far.
void keep_best(const std::vector<Pair>& pairs, const Data& data, const Policy& policy, Diagnosis& diagnosis) {
  const Stage& so_far = diagnosis.unnamed ? diagnosis.unnamed->stage : diagnosis.final_stage;
  std::vector<const Refit*> refits;
  for (const Pair& pair : pairs) {
    refits.push_back(&pair.refit);
  }
  const Refit* best = best_predicting(so_far, refits, data, policy);
  for (const Pair& pair : pairs) {
    if (&pair.refit == best) {
      diagnosis.unnamed =
          Unnamed{{name_of(pair.first), name_of(pair.second)}, after(*best), diagnosis.accepted.empty()};
    }
  }
}

}  // namespace

void look_for_pair(const Tried& first, const effects::Catalogue& catalogue, const Data& data,
                   const Policy& policy, const Progress& progress, Diagnosis& diagnosis) {
  const bool is_hopeless =
      diagnosis.accepted.size() > 1 && !is_below(policy.hopeless, diagnosis.final_stage.estimate, data);
  if (first.refits.empty() || is_hopeless || is_below(policy.finished, first.refits.front().estimate, data)) {
    return;
  }
  const std::vector<Pair> pairs = look_ahead(first, catalogue, data, policy, progress);
  const Choice choice = choose_pair(first, pairs, data, policy);
  diagnosis.pairs = pair_rows(pairs, choice);
  if (accept_half(first, pairs, data, policy, progress, diagnosis)) {
    return;
  }
  if (choice.named < 0) {
    keep_best(pairs, data, policy, diagnosis);
    return;
  }
  const Pair& pair = pairs[static_cast<std::size_t>(choice.named)];
  const Stage both = after(pair.refit);
  const Stage single = fitted_anew(without_effect(both, pair.refit.added.back()), data);
  // Better than either half, and than what is named already: far above the floor a part of the answer.
  const double enough = (1.0 - policy.material) *
                        std::min(judged(single.estimate, data), judged(diagnosis.final_stage.estimate, data));
  if (judged(both.estimate, data) < enough) {
    accept_pair(first, pairs, choice, single, data, diagnosis);
  }
}

}  // namespace plumbline::validation
