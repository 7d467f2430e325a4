// The refit of one candidate.
#pragma once

#include "validation/identify/diagnose/refit.h"

namespace plumbline::validation {

/// Has its law corners, as a stop or play has?
bool jumps(const model::EffectUse& use);

/// How much work a refit is worth.
struct Effort {
  int iterations = 4;
  bool by_parts = true;  ///< of laws that jump: also by way of the windows' beginnings
};

/// A straight line may promise values at which the model cannot be integrated, or from which the search ends
/// above where it began: then from nearer to the start, and from the stage's own initial states. A law that
/// changes nothing at its start ends no worse than without it.
Refit refit_one(const Stage& stage, const Candidate& candidate, const Hypothesis& hypothesis,
                const Data& data, const Effort& effort);

/// Mean square of a refit on every third window of either role, floor units; infinite where it fails.
double square_on_some(const Stage& stage, const Candidate& candidate, const Hypothesis& hypothesis,
                      const Data& data, const Effort& effort);

/// A law with corners takes many times the work of all others, and another start of a law mostly ends where
/// the first did. Above the floor they are refitted on every third window first: is it better there than the
/// best so far?
bool is_better_on_some(const Stage& stage, const Candidate& candidate, const Hypothesis& hypothesis,
                       const Data& data, const Effort& effort, const Refit& best);

/// A full refit, if it can be had. Of a friction that explains nearly all of the squared error before it, or
/// that is near the floor, how it fades towards standstill is fitted, too.
void finish_one(Refit& one, double square_before, const Candidate& candidate, const Data& data,
                const Policy& policy, const Progress& progress);

}  // namespace plumbline::validation
