// A pair of effects as the answer, where one after the other leads nowhere.
#pragma once

#include "validation/identify/diagnose/look_ahead.h"

namespace plumbline::validation {

/// Two effects at once, from the model with nothing added, or one that was only found beside another. They
/// are an answer only at the floor: any two laws help where nothing fits. `first` is the first round from
/// that model; without refits, or where one of them is at the floor, nothing is tried.
void look_for_pair(const Tried& first, const effects::Catalogue& catalogue, const Data& data,
                   const Policy& policy, const Progress& progress, Diagnosis& diagnosis);

}  // namespace plumbline::validation
