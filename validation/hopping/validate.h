// A simulated hopping robot held against what was published about the real one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/hopping/hop_statistics.h"
#include "validation/hopping/published.h"
#include "validation/hopping/return_map.h"

namespace plumbline::validation {

struct ValidateOptions {
  long hops = 100;      ///< of the run from the default start
  int starts = 48;      ///< random starts
  long enough = 40;     ///< hops from each that count as sustained
  int draws = 0;        ///< robots with drawn values
  double share = 0.05;  ///< within which they are drawn
  bool orbit = true;    ///< look for the orbit and its multipliers
  bool without = true;  ///< the starts once more without the update of the torso
  std::uint64_t seed = 1;
  HopOptions run;
};

/// What is held against what.
struct ValidateInputs {
  model::Model model;
  controllers::HoppingConfig controller;
  std::optional<controllers::HoppingConfig> tuned_rigid;  ///< gains found on rigid cables
  std::vector<Published> published;
};

/// A published quantity and its simulated counterpart.
struct PublishedVerdict {
  Published published;
  std::optional<Spread> simulated;  ///< none: not measured in this run
  std::string remark;               ///< why not, or what to know about the number
  bool holds() const { return simulated && published.outside(simulated->mean) == 0.0; }
};

/// How many runs hopped on long enough.
struct Share {
  std::string what;
  int sustained = 0, runs = 0;
  double median_hops = 0.0;
};

struct Validation {
  std::vector<PublishedVerdict> verdicts;
  std::vector<Share> shares;
  HopRun run;                ///< from the default start
  HopStatistics statistics;  ///< over the random starts
  std::optional<Orbit> orbit;
  bool holds() const;  ///< all that was measured
};

/// Told the part and the share of it that is done.
using ValidateProgress = std::function<void(const std::string& what, double fraction)>;

/// Throws Stopped, and InputError for a model that
/// cannot hop.
Validation validate(const ValidateInputs& inputs, const ValidateOptions& options,
                    const ValidateProgress& progress);

}  // namespace plumbline::validation
