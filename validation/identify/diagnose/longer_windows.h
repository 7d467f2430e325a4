// Whether a law that gives the robot a part which no sensor shows holds on longer motions.
#pragma once

#include <string>

#include "validation/identify/diagnose/refit.h"

namespace plumbline::validation {

/// The motor's side of a compliant drive that only the joint's encoder watches begins anew in each window:
/// over a short one a torque of the window's own, which makes up for whatever is missing. Such a law must
/// hold where there are half as many beginnings: on windows twice as long, with the values as fitted, its
/// held-out error (train, where nothing is held out) has to be below that of the stage by Policy::material.
/// Returns why it is not, in a few words; empty where it is, where the refit adds no unseen position, and
/// where the trials are too short to ask.
std::string short_lived(const Stage& stage, const Refit& refit, const Data& data, const Policy& policy);

}  // namespace plumbline::validation
