// Which of many candidates are worth a refit, where a straight line cannot say it.
#pragma once

#include <vector>

#include "validation/identify/diagnose/screen.h"

namespace plumbline::validation {

/// Refits all on every third window, and returns the few that come nearest there, the best first: a race of
/// one lap (Maron and Moore 1997, on racing among models).
std::vector<const Hypothesis*> race(const Stage& stage, const std::vector<Candidate>& candidates,
                                    const std::vector<const Hypothesis*>& entrants, const Data& data,
                                    const Progress& progress);

}  // namespace plumbline::validation
