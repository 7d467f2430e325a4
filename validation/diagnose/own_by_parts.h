// The model's own numbers where the error over a window has many minima.
#pragma once

#include "validation/diagnose/screen.h"

namespace plumbline::validation {

/// The stage with its open numbers (with_open_numbers) fitted to `data` from where they stand.
Stage fit_open_numbers(const Stage& open, const Data& data);

/// The same where a fit to all at once ends in a neighbouring minimum: on short beginnings of the windows of
/// `data` first, which are `part` of the windows' lengths, then on longer ones, each from where the one
/// before ended and with the numbers open that can be noticed there, within `width` stated deviations. The
/// estimate is of all of `data`. The stage as it is given where the model cannot be integrated on the way.
Stage fit_own_by_parts(const Stage& given, double part, double width, const Data& data);

}  // namespace plumbline::validation
