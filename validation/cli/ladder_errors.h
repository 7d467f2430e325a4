// Where each model of a ladder fails: by trial, by phase of the motion and by channel.
#pragma once

#include <vector>

#include "validation/api/ladder.h"

namespace plumbline::cli {

/// One table with a column for each model, numbered as in the ladder: error of each trial and of each phase
/// in units of the floor (root mean square over channels), and of each channel in its unit (root mean square
/// over trials of one role). Then the windows that a model lost, which are in none of its errors.
void print_errors(const std::vector<api::LadderRung>& rungs);

}  // namespace plumbline::cli
