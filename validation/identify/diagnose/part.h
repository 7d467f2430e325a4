// The windows on which costly starts are screened.
#pragma once

#include <cstddef>
#include <vector>

#include "validation/identify/diagnose/screen.h"

namespace plumbline::validation {

/// Enough to tell, spread over the trials: of more than 16 windows telling ones, of two neighbours the one
/// that shows more of what is missing, of segments one of more.
std::vector<int> enough_to_tell(const Stage& stage, const Data& data);

/// One of each `stride` windows of a role in a row: that at the upper quartile of their errors, since a short
/// segment may show nothing of what is missing, and the worst may be one whose search is lost.
std::vector<int> telling(const Stage& stage, std::size_t stride, const std::vector<int>& windows,
                         const Data& data);

}  // namespace plumbline::validation
