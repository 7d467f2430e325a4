// How well a diagnosis knows the values that it leaves in its final model.
#pragma once

#include "validation/identify/diagnose/diagnose.h"

namespace plumbline::validation {

/// One standard deviation of a parameter of the final stage, SI: held against the cost where that was done,
/// that of the finding, or what was known of it beforehand; NaN for what was not estimated (structural
/// constants).
double found_deviation(const Diagnosis& diagnosis, const model::ParameterId& id);

/// Of all parameters of the final model's effect of this index, in the law's order.
effects::Values found_deviations(const Diagnosis& diagnosis, int effect);

}  // namespace plumbline::validation
