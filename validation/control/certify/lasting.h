// One run of a certificate: how many cycles a robot makes under the controller, and what the driver would
// have seen.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "controllers/driver/json.h"
#include "controllers/driver/plan.h"
#include "simulator/run/scenario.h"
#include "validation/control/gait/gait.h"

namespace plumbline::validation {

/// Share of samples that are lost and late on the way, drawn from a seed.
struct WireOfRun {
  double lost = 0.0, late = 0.0;
};

/// What was largest in a run. One for each channel, command or reach of the plan.
struct Extremes {
  Eigen::VectorXd rate;     ///< largest magnitude of a channel's change in a sample, its unit/s
  Eigen::VectorXd rest;     ///< longest time without a change, s
  Eigen::VectorXd command;  ///< largest magnitude
  Eigen::VectorXd slew;     ///< largest magnitude of its change, unit/s
  Eigen::VectorXd margin;   ///< least distance to the nearer limit as a share of the range; of the stopping
                            ///< position too
  void widen(const Extremes& other);
};

struct LastingRun {
  long cycles = 0;
  std::string end;         ///< why it ended early; empty: it lasted
  std::string supervisor;  ///< what the supervisor would have stopped it for; empty: nothing
  Extremes extremes;
  Eigen::MatrixXd channels;  ///< channels x samples, where they are kept
};

driver::Json to_json(const LastingRun& run);
LastingRun lasting_run_from(const driver::Json& json);

struct LastingOptions {
  long cycles = 40;
  WireOfRun wire;
  std::uint64_t seed = 1;  ///< of the sensors' noise and of the wire
  long keep = 0;           ///< samples whose channels are kept
};

/// The scenario with its controller until it has made enough cycles, an end of the scenario is reached or its
/// length is over. Throws InputError for what does not fit together.
LastingRun last(const run::LoadedScenario& loaded, const Gait& gait, const driver::Plan& plan,
                const LastingOptions& options);

}  // namespace plumbline::validation
