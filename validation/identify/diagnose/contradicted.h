// Whether the held-out motion asks for the strength that the train motion has given a law.
#pragma once

#include "validation/identify/diagnose/screen.h"

namespace plumbline::validation {

/// Change of an effect's strength, all of its fitted values by the same share, that the held-out windows
/// alone ask for at the values that serve all windows best: with H and g their normal equations and d the
/// values,
///   |d' g| / (d' H d)
/// 1: they ask for none of it, or for twice as much. 0 without held-out windows or fitted values.
double asked_otherwise(const Stage& stage, int effect, const Data& data);

}  // namespace plumbline::validation
