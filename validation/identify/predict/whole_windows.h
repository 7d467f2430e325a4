// Whole windows that a model can be followed through.
#pragma once

#include "validation/identify/predict/reach.h"

namespace plumbline::validation {

/// Does the search of the initial states settle in at least nine of ten windows, or end at the floor, and do
/// those that it leaves above the floor expand errors (Predictor::expansion) at most thirtyfold? Windows
/// without contact, stops or play always can.
bool can_be_followed_whole(const model::Model& model, const Data& data);

/// Of a window whose initial state's next step promises the floor while no step leads there the beginning
/// that was at the floor; the others whole.
Followed follow_whole(const model::Model& model, const Data& data);

}  // namespace plumbline::validation
