#include "tests/battery/worlds/play.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "simulator/model/known_effects.h"
#include "tests/battery/worlds/lab.h"
#include "tests/battery/worlds/recorder.h"
#include "tests/battery/worlds/visibility.h"
#include "validation/twin/experiment.h"

namespace plumbline::battery::worlds {
namespace {

using validation::Experiment;
using validation::Role;
using validation::Trial;

std::string in_root(const std::string& file) { return std::string(PLUMBLINE_ROOT) + "/" + file; }

// Slots and poles that the search's list of usual counts has not.
constexpr std::array<double, 8> kUnusualCycles{5, 9, 11, 13, 15, 17, 26, 33};
constexpr double kExponentSpread = 0.5;  // of Stribeck's exponent about 2: half to two is reported for oils

/// Constants of shape that no search knows.
void leave_the_grid(Hidden& effect, Draw& draw) {
  if (effect.effect == "cogging") {
    effect.values["cycles"] = kUnusualCycles[draw.seed() % kUnusualCycles.size()];
  }
  if (effect.effect == "stribeck") {
    effect.values["stribeck_exponent"] = 2.0 + kExponentSpread * draw.deviations() / kMostDeviations;
  }
}

/// Without a hidden effect the excitation differs from seed to seed, as it does for twins of our own.
void vary(Experiment& experiment, Draw& draw) {
  for (validation::Command& command : experiment.commands) {
    const double mean = command.values.mean();
    command.values = (mean + draw.factor() * (command.values.array() - mean)).matrix();
  }
  for (validation::Controller& controller : experiment.controllers) {
    controller.reference *= draw.factor();
  }
}

}  // namespace

bool can_play(const Case& one) {
  return has_rig(one.robot) &&
         std::all_of(one.rows.begin(), one.rows.end(), [](const Row& row) { return is_known(row.effect); });
}

Played play(const Case& one, const model::Model& bare, const std::vector<std::string>& hidden, Draw& draw,
            const PlayOptions& options) {
  Played played;
  Rig without = rig_of(one.robot, bare);
  if (!options.as_stated) {
    scatter(stated(bare), draw, without);
  }
  if (options.lab) {
    scatter(unstated(without), draw, without);
  }
  Rig with = without;
  for (const std::string& text : hidden) {
    Hidden effect = hidden_from(text);
    if (options.lab) {
      leave_the_grid(effect, draw);
    }
    hide(effect, with);
    played.text += (played.text.empty() ? "" : " ") + text;
  }
  std::mt19937_64 noise(options.seed);
  for (const std::string& file : robot_of(one).experiments) {
    Experiment experiment = validation::read_experiment(in_root(file), bare);
    if (one.kind == Kind::none) {
      vary(experiment, draw);
    }
    const bool held_out = experiment.role == Role::held_out;
    if (options.held_out_only && !held_out) {
      continue;
    }
    const Recording recording = record(with, experiment, bare, options.mujoco ? one.robot : "");
    played.trials.push_back(trial_of(recording, experiment, bare, noise));
    played.trials.back().name = played.trials.back().file = file;
    if (held_out && !hidden.empty()) {
      played.visible = std::max(played.visible, visibility(recording, without, stated(bare)));
    }
  }
  return played;
}

}  // namespace plumbline::battery::worlds
