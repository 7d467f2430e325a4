// What a diagnosis found, in words.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/diagnose/diagnose.h"

namespace plumbline::validation {

/// "Nothing is missing: ...", "Unexplained: ..."; empty for the verdict `missing`, whose findings speak for
/// themselves.
std::string verdict_sentence(const Diagnosis& diagnosis);

/// "Missing: coulomb at drive. With it the held-out error falls from ... to ..."
/// The last error is the ladder's, on all windows, where the finding is the last.
std::string finding_sentences(const Finding& finding, const Diagnosis& diagnosis);

/// "Something is missing at m_tail: a law there is the best in 93 % of the resamples. Which one these data
/// cannot tell: actuator_lag 61 %, rotor_inertia 32 %."
std::string one_place_sentence(const OnePlace& place);

/// What else is to be known of an answer, a few sentences each: what the train trials leave open of it, and
/// on what part of the windows it was found. Needs a rung on the ladder.
std::vector<std::string> remarks(const Diagnosis& diagnosis);

/// The whole answer in a few sentences.
std::string summary(const Diagnosis& diagnosis);

}  // namespace plumbline::validation
