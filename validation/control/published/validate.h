// A simulated robot held against what was published about the real one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/control/published/published.h"

namespace plumbline::validation {

struct ValidateOptions {
  long cycles = 100;    ///< of the run from the scenario's start
  int starts = 48;      ///< random starts
  long enough = 40;     ///< cycles from each that count as sustained
  int draws = 0;        ///< robots with drawn values
  double share = 0.05;  ///< within which they are drawn
  bool orbit = true;    ///< look for the orbit and its multipliers where they are published
  bool held = true;     ///< the starts once more with the section's `held` constants
  std::uint64_t seed = 1;
  run::RunOptions run;
  const StopFlag* stop = nullptr;
  work::Workers* workers = nullptr;  ///< of several ranks: runs and points of the return map are shared
};

/// A published number or curve and its simulated counterpart.
struct Verdict {
  std::string name, measure, source;
  std::string unit;  ///< as published
  PublishedQuantity::Relation relation = PublishedQuantity::Relation::value;
  double published = 0.0, tolerance = 0.0;  ///< SI
  std::optional<Spread> simulated;          ///< SI; none: not measured in this run
  double outside = 0.0;  ///< by how much the simulated one is outside the tolerance, SI, signed
  std::string remark;    ///< why not, or what to know about the number
  /// Of a curve: where it is held against the simulated one, SI. No channel: the verdict is of a number.
  struct Curve {
    std::string channel;
    bool over_shares = false;
    Eigen::VectorXd at, published, spread, simulated, deviation;
  } curve;
  bool holds() const { return simulated && outside == 0.0; }
};

struct GaitValidation {
  std::string gait, title;
  std::vector<Verdict> verdicts;
  std::vector<Share> shares;
  GaitRun run;  ///< from the scenario's start
  std::optional<Orbit> orbit;
  double duration = 0.0;  ///< mean of the settled cycles over the starts, s
  int not_measured() const;
  /// All of them were measured and are within their tolerance: what was not measured cannot pass.
  bool holds() const;
};

/// Told the part and the share of it that is done.
using ValidateProgress = std::function<void(const std::string& what, double fraction)>;

/// Throws Stopped, and InputError for what does not fit together.
GaitValidation validate(const PublishedGait& published, const ValidateOptions& options,
                        const ValidateProgress& progress);

}  // namespace plumbline::validation
