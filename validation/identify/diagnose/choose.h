// Which of several refits is named, and what the data cannot tell from it.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/diagnose/refit.h"

namespace plumbline::validation {

struct Choice {
  int named = -1;                       ///< index of the refit; -1: something speaks against each of the best
  double share = 0.0;                   ///< of the resamples that choose it, its family there, or one as good
  std::vector<std::size_t> rivals;      ///< of the named one
  std::vector<double> shares;           ///< by refit: share of the resamples in which it is the best
  std::vector<std::string> objections;  ///< by refit: why it is not named; empty when it could be
};

/// Of the refits (best first) that are not refused (objection.h) and are about as good as the best, the one
/// with the fewest fitted parameters is named, of equally many the one with the fewest constants, if nothing
/// speaks against it. Better in nearly all resamples counts for more among equally many parameters, and at
/// the floor; above it a law that contains another is not preferred to it for an immaterial gain.
Choice choose(const Stage& stage, const std::vector<Refit>& refits, const Data& data, const Policy& policy);

}  // namespace plumbline::validation
