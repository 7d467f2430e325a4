// Gains that the paper does not give, by a search that can be run again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/hopping/hop_statistics.h"
#include "validation/hopping/published.h"

namespace plumbline::validation {

struct HopSearchOptions {
  int trials = 60;     ///< gain sets tried
  int starts = 8;      ///< runs for each
  long hops = 40;      ///< enough
  double width = 0.4;  ///< standard deviation of the first sets, in the logarithm
  bool sides = false;  ///< left and right leg may have different gains
  std::uint64_t seed = 1;
  HopOptions run;
  std::vector<Published> published;  ///< those measured hop by hop count in the cost
};

struct HopSearchResult {
  controllers::HoppingConfig config;
  double cost = 0.0;
  HopStatistics statistics;
  bool interrupted = false;  ///< options.run.stop was raised before all sets were tried
};

/// A number that is searched, positive, as the controller's file names it.
struct Searched {
  std::string name;
  double value = 0.0;
};
std::vector<Searched> searched_values(const controllers::HoppingConfig& config, bool sides);

/// 20 (1 - mean over the runs of min(hops, enough)/enough) + sum over the quantities of log(1 + mean d^2), d
/// how far a settled hop is from what was published, in units of its tolerance (0 on the right side of a
/// limit; 30 without a settled hop). Falling costs more than any one quantity, and a gait that wanders costs
/// more than a steady one of the same mean.
double hopping_cost(const controllers::HoppingConfig& config, const std::vector<HopRun>& runs, long enough,
                    const std::vector<Published>& published);

/// Looks for kp and kd of leg angle and leg shape, K_T, and the lengths of their rate filters (2 to 12
/// samples), in the logarithm about `around`, by CmaSearch on hopping_cost. Returns the cheapest set that was
/// tried, also when it is interrupted; before the first is tried Stopped is thrown. Deterministic for a seed.
/// `progress` is told of each set in its order.
HopSearchResult search_gains(const model::Model& model, const controllers::HoppingConfig& around,
                             const HopSearchOptions& options,
                             const std::function<void(int, const HopSearchResult&)>& progress);

}  // namespace plumbline::validation
