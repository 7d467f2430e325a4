// Where something is missing, when the place is sure and the law is not.
#pragma once

#include <optional>
#include <vector>

#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/diagnose/policy.h"

namespace plumbline::validation {

/// Adds up the shares of laws at one place, a motor and the coordinate that it turns rigidly being one. The
/// place with the most is the answer if laws there were the best in at least `policy.stable` of the
/// resamples, and there are two or more of them; its name is that of its most probable law.
std::optional<OnePlace> at_one_place(std::vector<LawShare> shares, const model::Model& model,
                                     const Policy& policy);

/// The same of the candidates that were refitted and to which nothing but their share was an objection.
std::optional<OnePlace> at_one_place(const std::vector<RankRow>& leads, const model::Model& model,
                                     const Policy& policy);

}  // namespace plumbline::validation
