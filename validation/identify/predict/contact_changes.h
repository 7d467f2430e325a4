// Where contacts close and open along a prediction.
#pragma once

#include "validation/identify/predict/windows.h"

namespace plumbline::validation {

/// Does a foot, or a pair of links, meet the other side or leave it from one sample to another of the window
/// predicted last?
bool do_contacts_change(Predictor& predictor);

}  // namespace plumbline::validation
