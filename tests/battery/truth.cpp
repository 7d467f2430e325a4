#include "tests/battery/truth.h"

#include "tests/battery/foreign_laws.h"
#include "validation/control/gait/gait_run.h"
#include "validation/identify/twin/recorded_run.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::battery {
namespace {

using validation::Role;
using validation::Trial;

constexpr double kTwinTolerance = 1e-9;
constexpr long kHops = 2;  // of each run: short enough that a robot that is to fall has not fallen

std::string in_root(const std::string& file) { return std::string(PLUMBLINE_ROOT) + "/" + file; }

/// Varies what a command does about its mean, which holds the robot against gravity, and what a controller is
/// asked to follow.
void vary_amplitudes(validation::Experiment& experiment, Draw& draw) {
  for (validation::Command& command : experiment.commands) {
    const double mean = command.values.mean();
    command.values = (mean + draw.factor() * (command.values.array() - mean)).matrix();
  }
  for (validation::Controller& controller : experiment.controllers) {
    controller.reference *= draw.factor();
  }
}

std::vector<Trial> experiments_of(const Case& one, const model::Model& bare, const Truth& truth, Draw& draw,
                                  const RunOptions& run) {
  validation::TwinOptions options;
  options.seed = run.seed;
  options.relative_tolerance = kTwinTolerance;
  std::vector<Trial> trials;
  for (const std::string& file : robot_of(one).experiments) {
    validation::Experiment experiment = validation::read_experiment(in_root(file), bare);
    if (one.kind == Kind::none) {
      vary_amplitudes(experiment, draw);
    }
    if (!run.bare_only || experiment.role == Role::held_out) {
      trials.push_back(validation::twin(truth.robot, experiment, options));
      trials.back().name = trials.back().file = file;
    }
    ++options.seed;
  }
  return trials;
}

/// A run to fit and one to judge by.
std::vector<Trial> hops_of(const Case& one, const Truth& truth, Draw& draw, const RunOptions& run) {
  run::LoadedScenario loaded = run::read_scenario(in_root(robot_of(one).scenario));
  loaded.model = truth.robot;
  const std::vector<run::LoadedScenario> starts = validation::from_starts(loaded, 2, draw.seed());
  validation::GaitView view;
  view.gait = *validation::read_gait(loaded);
  validation::GaitOptions options;
  options.enough = kHops;
  options.run.trace = true;
  options.run.integrator.set_tolerance(kTwinTolerance);
  std::vector<Trial> trials;
  for (const Role role : {Role::train, Role::held_out}) {
    if (run.bare_only && role == Role::train) {
      continue;
    }
    options.run.sensors.seed = draw.seed();
    const run::LoadedScenario& start = starts[role == Role::train ? 0 : 1];
    const validation::GaitRun hops = validation::run_gait(start, view, options);
    trials.push_back(validation::recorded_run(truth.robot, hops.run.record, start.scenario));
    trials.back().role = role;
    trials.back().name = trials.back().file = "hops, " + to_string(role);
  }
  return trials;
}

}  // namespace

Truth truth_of(const Case& one, const model::Model& bare, Draw& draw, const RunOptions& run) {
  Truth truth{one.kind == Kind::foreign ? with_foreign_places(bare) : bare, {}, ""};
  for (const Row& row : one.rows) {
    const std::string with = drawn_effect(row, one.strength, every_law(), draw);
    truth.hidden.push_back(validation::parse_effect(with, truth.robot, every_law()));
    truth.text += (truth.text.empty() ? "" : " ") + with;
  }
  if (!run.as_stated) {
    truth.robot = scattered(truth.robot, draw);
  }
  truth.robot.effects.insert(truth.robot.effects.end(), truth.hidden.begin(), truth.hidden.end());
  return truth;
}

std::vector<Trial> trials_of(const Case& one, const model::Model& bare, const Truth& truth, Draw& draw,
                             const RunOptions& run) {
  return robot_of(one).scenario.empty() ? experiments_of(one, bare, truth, draw, run)
                                        : hops_of(one, truth, draw, run);
}

}  // namespace plumbline::battery
