// What speaks against a refit.
#pragma once

#include <string>

#include "validation/diagnose/refit.h"

namespace plumbline::validation {

/// Why a refit cannot be the law that it claims, whatever the others do, in a few words: a value at its
/// bound, or one that cannot be told from no effect. Empty when nothing is wrong with it.
std::string flaw(const Refit& refit, const Data& data, const Policy& policy);

/// Why a refit without a flaw may not be accepted; empty when it may.
std::string objection(const Stage& stage, const Refit& refit, double share, const Data& data,
                      const Policy& policy);

}  // namespace plumbline::validation
