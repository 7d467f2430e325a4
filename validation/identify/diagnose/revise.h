// What was named before the other effects were in the model, looked at again with them in it.
#pragma once

#include "validation/identify/diagnose/diagnose.h"

namespace plumbline::validation {

/// A model effect less.
Stage without_effect(const Stage& stage, int effect);

/// Each finding but the last was chosen while something else was still missing, and so were its rivals. With
/// everything named in the model its place is tried with each rival: one that now predicts better in enough
/// resamples takes the place, and one that is now surely worse is no rival any more.
void revise_rivals(const effects::Catalogue& catalogue, const Data& data, const Policy& policy,
                   const Progress& progress, Diagnosis& diagnosis);

/// A mass that was added to a body, and a centre of mass that was shifted, are what something that hangs
/// there does. Where a payload at the body leaves the same error, within Policy::simpler, it is the name, and
/// the other one its rival with the share of the resamples in which it is better. Not so where the payload
/// asks for numbers of the robot that are less believable (at Policy::fair) than those beside the other one.
void name_payloads(const effects::Catalogue& catalogue, const Data& data, const Policy& policy,
                   const Progress& progress, Diagnosis& diagnosis);

}  // namespace plumbline::validation
