// By which error a model is judged.
#pragma once

#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {

/// The error that counts: held-out, as foretold, where there is one.
double judged(const Estimate& estimate, const Data& data);

/// Are that error and the one on train both below a limit, in floors?
bool is_below(double limit, const Estimate& estimate, const Data& data);

/// The error that counts at the values that the train windows ask for: held-out where there is one.
double judged(const Scores& scores, const Data& data);

}  // namespace plumbline::validation
