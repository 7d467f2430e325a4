// What a diagnosis found, in words.
#pragma once

#include <string>

#include "validation/diagnose/diagnose.h"

namespace plumbline::validation {

/// "Nothing is missing: ...", "Unexplained: ..."; empty for the verdict `missing`, whose findings speak for
/// themselves.
std::string verdict_sentence(const Diagnosis& diagnosis);

/// "Missing: coulomb at drive. With it the held-out error falls from ... to ..."
std::string finding_sentences(const Finding& finding, Verdict verdict);

/// On what part of the windows the model was diagnosed, how far it goes with what was found, and how many
/// windows end early; empty where that is the whole.
std::string part_sentence(const Diagnosis& diagnosis);

/// Where the held-out error at the train trials' best values is much larger than the foretold one, which
/// decides (validation/predict/foretell.h): a caution with both; else empty. Needs a rung on the ladder.
std::string open_values_sentence(const Diagnosis& diagnosis);

/// The whole answer in a few sentences.
std::string summary(const Diagnosis& diagnosis);

}  // namespace plumbline::validation
