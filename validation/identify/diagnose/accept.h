// What was chosen, taken into a diagnosis: its finding, its stage and its rung together.
#pragma once

#include <vector>

#include "validation/identify/diagnose/choose.h"
#include "validation/identify/diagnose/look_ahead.h"
#include "validation/identify/diagnose/standard_effects.h"

namespace plumbline::validation {

/// The chosen one of the tried effects.
void accept(const Tried& tried, const Choice& choice, const Data& data, Diagnosis& diagnosis);

/// The chosen pair, in place of everything that was accepted before. `single` is its first effect alone.
void accept_pair(const Tried& tried, const std::vector<Pair>& pairs, const Choice& choice,
                 const Stage& single, const Data& data, Diagnosis& diagnosis);

/// All effects of a group, with one rung.
void accept_group(const Tried& tried, const Group& group, const Data& data, Diagnosis& diagnosis);

/// Back to the model that nothing was added to.
void drop_accepted(Diagnosis& diagnosis);

}  // namespace plumbline::validation
