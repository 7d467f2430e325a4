// The windows on which costly starts are screened.
#pragma once

#include <cstddef>
#include <vector>

#include "validation/identify/diagnose/screen.h"

namespace plumbline::validation {

/// Some of the windows, and what share of the stage's mean squared error is theirs: promises made on them are
/// brought to all windows by it.
struct Part {
  std::vector<int> windows;
  double train_share, held_out_share;
};

Part part_of(const Stage& stage, const std::vector<int>& windows, const Data& data);

/// Enough to tell, spread over the trials: of more than 16 windows every second one, of segments, which are
/// many, telling ones.
Part enough_to_tell(const Stage& stage, const Data& data);

/// One of each `stride` windows of a role in a row: that at the upper quartile of their errors, since a short
/// segment may show nothing of what is missing, and the worst may be one whose search is lost.
std::vector<int> telling(const Stage& stage, std::size_t stride, const std::vector<int>& windows,
                         const Data& data);

}  // namespace plumbline::validation
