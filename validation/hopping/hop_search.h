// Gains that the paper does not give, by a search that can be run again.
#pragma once

#include <cstdint>
#include <functional>

#include "validation/hopping/hop_statistics.h"

namespace plumbline::validation {

struct HopSearchOptions {
  int trials = 60;  ///< gain sets tried
  int starts = 8;   ///< runs for each
  long hops = 40;   ///< enough
  std::uint64_t seed = 1;
  HopOptions run;
};

struct HopSearchResult {
  controllers::HoppingConfig config;
  double score = 0.0;
  HopStatistics statistics;
};

/// Looks for kp and kd of leg angle and leg shape (the same on both sides), K_T, and the lengths of their
/// rate filters that keep the robot hopping: the first third of the trials is drawn evenly in the logarithm
/// over a factor of four to either side of `around`, the rest normally about the best so far with a width
/// that shrinks. Score: mean over the starts of min(hops, enough)/enough, times 0.1 and up to one more for a
/// travel and a lean near those that the controller is asked for: a robot that bounces in place is not the
/// gait that is looked for. Deterministic for a seed. `progress` is told of each trial and its result.
HopSearchResult search_gains(const model::Model& model, const controllers::HoppingConfig& around,
                             const HopSearchOptions& options,
                             const std::function<void(int, const HopSearchResult&)>& progress);

}  // namespace plumbline::validation
