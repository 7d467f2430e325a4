// What is done with a diagnosis when nothing more is looked for.
#pragma once

#include "validation/identify/diagnose/diagnose.h"

namespace plumbline::validation {

/// A guess that the others make superfluous is dropped again: an early one, or a rival that took its place;
/// and before them one without which the error that counts is lower.
void drop_superfluous(const Data& all, const Policy& policy, const Progress& progress, Diagnosis& diagnosis);

/// Far from the floor a law that the held-out motion asks nothing of (contradicted.h), with which the
/// held-out error rises, or which leaves more of the squared error above the floor than it explains, the last
/// first, may still lower the error: it makes up for something else. It stays in the best model if that
/// predicts better, and is no name.
void leave_doubtful_unnamed(const Data& all, const Policy& policy, const Progress& progress,
                            Diagnosis& diagnosis);

/// Is there a name with which the held-out error is higher than without it?
bool has_risen(const Data& all, const Diagnosis& diagnosis);

/// The last values of an answer, to a tenth of a standard deviation and better: searches among candidates end
/// as soon as they can be told apart.
void settle_values(const Data& all, const Progress& progress, Diagnosis& diagnosis);

/// Deviations of the named effects' values held against the cost itself (predict/profile.h), and what is
/// better than the last values and was met on that way. After settle_values.
void hold_values(const Data& all, const Progress& progress, Diagnosis& diagnosis);

/// Where a named law is nothing at the train trials' best values, those are taken that serve all trials, and
/// its finding says so. True where there is one.
bool take_open_values(const Data& all, Diagnosis& diagnosis);

/// Nothing is named any more: what was is told as withdrawn.
void withdraw_names(const Data& data, const Policy& policy, Diagnosis& diagnosis);

/// The verdict, and the share of the squared error above the floor that is left.
void conclude(const Data& data, const Policy& policy, Diagnosis& diagnosis);

}  // namespace plumbline::validation
