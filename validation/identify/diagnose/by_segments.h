// A diagnosis where the model cannot be followed through whole windows.
#pragma once

#include <optional>

#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/predict/reach.h"

namespace plumbline::validation {

/// From the segments of the windows of `data` over which the model can be followed to the whole windows. The
/// model's own numbers are free; effects are looked for where it cannot be followed any further with what has
/// been found. Returns the windows on which it ended.
Followed diagnose_by_segments(const model::Model& model, const effects::Catalogue& catalogue,
                              const Data& data, const Followed& segments, const Policy& policy,
                              const Progress& progress, Diagnosis& diagnosis);

/// Where the model as given is so far from the measurements on whole windows (above Policy::hopeless) that no
/// straight line tells what is missing: from the longest segments on which it is nearer, if a law
/// that is linear where it is nothing promises the floor there. A motion that leaves the model's stays beside
/// it for as long as a window is short. Nothing where that ends in no answer on whole windows; then
/// `diagnosis` is what it was.
std::optional<Followed> diagnose_from_nearer(const model::Model& model, const effects::Catalogue& catalogue,
                                             const Data& data, const Followed& whole, const Policy& policy,
                                             const Progress& progress, Diagnosis& diagnosis);

}  // namespace plumbline::validation
