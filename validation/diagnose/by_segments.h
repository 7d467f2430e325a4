// A diagnosis where the model cannot be followed through whole windows.
#pragma once

#include "validation/diagnose/diagnose.h"
#include "validation/predict/reach.h"

namespace plumbline::validation {

/// From the segments of the windows of `data` over which the model can be followed to the whole windows. The
/// model's own numbers are free; effects are looked for where it cannot be followed any further with what has
/// been found. Returns the windows on which it ended.
Followed diagnose_by_segments(const model::Model& model, const effects::Catalogue& catalogue,
                              const Data& data, const Followed& segments, const Policy& policy,
                              const Progress& progress, Diagnosis& diagnosis);

}  // namespace plumbline::validation
