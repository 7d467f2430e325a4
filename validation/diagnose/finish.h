// What is done with a diagnosis when nothing more is looked for.
#pragma once

#include "validation/diagnose/diagnose.h"

namespace plumbline::validation {

/// The ladder on all windows, where candidates were tried on some of them; of its rungs those that reach as
/// far into the windows as the last.
void rescore(const Data& all, const Policy& policy, const Progress& progress, Diagnosis& diagnosis);

/// The errors of every rung as `compare` gives them of its model, and those of the findings from them, so
/// that an answer has one number for one thing; not where a rung is of segments.
void compare_rungs(const Data& all, const Progress& progress, Diagnosis& diagnosis);

/// A guess that the others make superfluous is dropped again: an early one, or a rival that took its place;
/// and before them one without which the error that counts is lower.
void drop_superfluous(const Data& all, const Policy& policy, const Progress& progress, Diagnosis& diagnosis);

/// The last values of an answer, to a tenth of a standard deviation and better: searches among candidates end
/// as soon as they can be told apart.
void settle_values(const Data& all, const Progress& progress, Diagnosis& diagnosis);

/// Deviations of the named effects' values held against the cost itself (predict/profile.h), and what is
/// better than the last values and was met on that way. After settle_values.
void hold_values(const Data& all, const Progress& progress, Diagnosis& diagnosis);

/// Where a named law is nothing at the train trials' best values, those are taken that serve all trials, and
/// its finding says so. True where there is one.
bool take_open_values(const Data& all, Diagnosis& diagnosis);

/// The verdict, and the share of the squared error above the floor that is left.
void conclude(const Data& data, const Policy& policy, Diagnosis& diagnosis);

}  // namespace plumbline::validation
