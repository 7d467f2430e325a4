// The ladder on all windows, where candidates were tried on some of them.
#pragma once

#include "validation/identify/diagnose/diagnose.h"

namespace plumbline::validation {

/// Fits each rung to all windows, from what was found on `some`; of the rungs those that reach as far into
/// the windows as the last.
void rescore(const Data& all, const Data& some, const Policy& policy, const Progress& progress,
             Diagnosis& diagnosis);

/// The errors of every rung as `compare` gives them of its model, and those of the findings from them, so
/// that an answer has one number for one thing; not where a rung is of segments.
void compare_rungs(const Data& all, const Progress& progress, Diagnosis& diagnosis);

}  // namespace plumbline::validation
