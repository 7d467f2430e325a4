// `plumbline simulate --scenario`: a robot under its controller.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulator/run/run_scenario.h"
#include "validation/cli/platforms.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::cli {

struct ScenarioOptions {
  std::string scenario, model, controller, out, record, json;
  std::vector<std::string> set;    ///< CONSTANT=VALUE of the controller, SI
  std::vector<std::string> start;  ///< clearance=VALUE, position:NAME=VALUE, velocity:NAME=VALUE, SI
  double seconds = 0.0;            ///< 0: as the scenario says
  long cycles = 0;                 ///< of the scenario's gait that end the run; 0: none
  int starts = 1;                  ///< random starts; more than 1: shares instead of a trace
  long enough = 40;                ///< cycles that count as sustained
  std::uint64_t seed = 1;          ///< of the sensors' noise
  double tolerance = 0.0;          ///< 0: the usual one
  std::optional<integrate::Method> method;
  bool energy = false;  ///< whether the energy adds up, too
  validation::Role role = validation::Role::train;
  Platforms platforms;
};

/// Runs it, prints the course and the strides, writes what was asked for.
void simulate_scenario(const ScenarioOptions& options);

/// The scenario with what the options put in its place. Throws InputError.
run::LoadedScenario load_scenario(const ScenarioOptions& options);

/// CONSTANT=VALUE, in SI.
void set_constant(run::ControllerSetup& setup, const std::string& text);

}  // namespace plumbline::cli
