// How much two explanations of the same error are one.
#pragma once

#include "validation/identify/diagnose/screen.h"

namespace plumbline::validation {

/// With r, a and b the residuals of all windows before and after either explanation, floor units, initial
/// states fitted each time: the cosine (r - a)'(r - b) / (|r - a| |r - b|) between what they take off the
/// residuals. 1: in these data they are one answer under two names. 0 when either changes nothing.
double correlation(const Stage& before, const Stage& one, const Stage& other, const Data& data);

}  // namespace plumbline::validation
