// A scenario run to its end.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulator/run/recorder.h"
#include "simulator/run/sampled_run.h"
#include "simulator/run/scenario.h"

namespace plumbline::run {

struct RunOptions : SampledOptions {
  bool trace = false;  ///< keep every sample
  /// Called at each sample, behind the controller's step; true ends the run. What it throws passes through.
  std::function<bool(SampledRun&)> watch;
};

struct RunRecord {
  double time = 0.0;  ///< simulated, s
  bool fell = false;  ///< ended by one of the scenario's ends, or by the integrator
  std::string end;    ///< why, in words; empty when it ran to its length or was ended by `watch`
  int fault = 0;      ///< of the controller at the last sample
  integrate::Summary summary;
  double energy_error = 0.0, energy_exchanged = 0.0;  ///< J; 0 unless asked for
  double seconds = 0.0;                               ///< wall time
  Table trace, record;                                ///< as of Recorder; empty unless asked for
};

/// Runs the scenario: at each sample the sensors are read once, the controller steps, its commands hold until
/// the next. Motors without a controller get command 0. Throws InputError for what does not fit together and
/// for terrain that reaches a foot at the start.
RunRecord run_scenario(const model::Model& model, const Scenario& scenario, const ControllerSetup* controller,
                       const RunOptions& options);

/// The scenario's start, above the terrain's floor. Throws InputError when a platform reaches a foot there.
Eigen::VectorXd state_at_start(const model::Model& model, const Scenario& scenario);

/// `count` starts drawn evenly from the scenario's ranges.
std::vector<Start> draw_starts(const Scenario& scenario, int count, std::uint64_t seed);

}  // namespace plumbline::run
