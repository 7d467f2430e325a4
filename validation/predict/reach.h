// How far into its windows a model can be followed.
#pragma once

#include "validation/predict/problem.h"

namespace plumbline::validation {

/// Share of every window's length over which the model can be followed: over longer ones the search of the
/// initial states ends above the floor and does not settle in more than a tenth of the windows, since through
/// contact, stops and play what a wrong model predicts departs from the measurements without a way back, and
/// slopes there promise what no step keeps. 1 where windows are linear in where they begin.
double reach(const model::Model& model, const Data& data);

/// The next longer part of the windows, at most 1.
double longer_part(double share);

}  // namespace plumbline::validation
