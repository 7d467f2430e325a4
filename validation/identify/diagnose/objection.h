// What speaks against a refit.
#pragma once

#include <string>

#include "validation/identify/diagnose/refit.h"

namespace plumbline::validation {

/// Where the search ended on a bound of this parameter.
bool on_bound(const FreeParameter& parameter, double value);

/// A parameter of an added effect that is on its bound, if it is the only one, the stiffness of a drive, the
/// level of a dry friction, or what the robot cannot be beyond (keep_physical); empty when there is none.
std::string unphysical(const Refit& refit);

/// Why a refit cannot be the law that it claims, whatever the others do, in a few words: a value at its
/// bound, or one that cannot be told from no effect. Empty when nothing is wrong with it.
std::string flaw(const Refit& refit, const Data& data, const Policy& policy);

/// Why a refit cannot be named, whatever the others do: an error that does not fall, or a flaw. Empty when it
/// can.
std::string refusal(const Stage& stage, const Refit& refit, const Data& data, const Policy& policy);

/// Why a refit that nothing else speaks against is not named with this share of the resamples; empty when it
/// is.
std::string objection(double share, const Policy& policy);

}  // namespace plumbline::validation
