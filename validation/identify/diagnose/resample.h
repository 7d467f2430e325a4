// How refits compare on windows drawn with replacement within each role: blocks, for the residuals of one
// window are correlated.
#pragma once

#include <utility>
#include <vector>

#include "validation/identify/diagnose/refit.h"

namespace plumbline::validation {

/// For each refit the share of block resamples (windows drawn with replacement) in which it is the best of
/// the `contenders`; the stage itself stands for "none" and wins unless a refit is material. Last entry: the
/// share of "none".
std::vector<double> selected_shares(const Stage& stage, const std::vector<Refit>& refits,
                                    const std::vector<std::size_t>& contenders, const Data& data,
                                    const Policy& policy);

/// Between which values 90 % of the resamples have the error of one role, in units of the floor.
std::pair<double, double> resampled_error(const Refit& refit, Role role, const Data& data,
                                          const Policy& policy);

/// Share of resamples in which `other` predicts better than `best`.
double share_better(const Refit& other, const Refit& best, const Data& data, const Policy& policy);

}  // namespace plumbline::validation
