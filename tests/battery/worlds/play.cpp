#include "tests/battery/worlds/play.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/run/run_scenario.h"
#include "tests/battery/worlds/hops.h"
#include "tests/battery/worlds/lab.h"
#include "tests/battery/worlds/recorder.h"
#include "tests/battery/worlds/visibility.h"
#include "validation/identify/twin/experiment.h"

namespace plumbline::battery::worlds {
namespace {

using validation::Experiment;
using validation::Role;

std::string in_root(const std::string& file) { return std::string(PLUMBLINE_ROOT) + "/" + file; }

// Slots and poles that few motors have.
constexpr std::array<double, 8> kUnusualCycles{5, 9, 11, 13, 15, 17, 26, 33};
constexpr double kExponentSpread = 0.5;  // of Stribeck's exponent about 2: half to two is reported for oils

constexpr std::array kBeyondMujoco{"resonator",     "current_loop",      "thermal_motor",
                                   "winding",       "slipping_coupling", "battery",
                                   "creeping_load", "tilting_mount",     "slow_reversal"};

bool is_beyond_mujoco(const std::string& name) {
  return std::find(kBeyondMujoco.begin(), kBeyondMujoco.end(), name) != kBeyondMujoco.end();
}

/// Constants of shape as few robots have them; no fit moves Stribeck's exponent.
void take_unusual_shape(Hidden& effect, Draw& draw) {
  if (effect.effect == "cogging" || effect.effect == "torque_ripple") {
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

constexpr int kHops = 2;  // of each run, as for twins of our own

/// The trials of `with`, and how far they show what `without` has not.
class Player {
 public:
  Player(const Case& one, const model::Model& bare, Rig without, Rig with, const PlayOptions& options)
      : one_(one),
        bare_(bare),
        without_(std::move(without)),
        with_(std::move(with)),
        options_(options),
        noise_(options.seed) {}

  void experiments(Draw& draw, Played& played) {
    for (const std::string& file : robot_of(one_).experiments) {
      Experiment experiment = validation::read_experiment(in_root(file), bare_);
      if (one_.kind == Kind::none) {
        vary(experiment, draw);
      }
      if (!is_left_out(experiment.role)) {
        add(record(with_, experiment, bare_, options_.mujoco ? one_.robot : ""), experiment, file, played);
      }
    }
  }

  /// A run to fit and one to judge by, each from a start of its own.
  void hops(Draw& draw, Played& played) {
    const run::LoadedScenario loaded = run::read_scenario(in_root(robot_of(one_).scenario));
    const std::vector<run::Start> starts = run::draw_starts(loaded.scenario, 2, draw.seed());
    for (const Role role : {Role::train, Role::held_out}) {
      if (!is_left_out(role)) {
        const Recording recording = hop(with_, loaded, starts[role == Role::train ? 0 : 1], kHops, noise_);
        add(recording, experiment_of(recording, loaded.scenario.title, role),
            "hops, " + validation::to_string(role), played);
        played.trials.back().terrain = loaded.scenario.terrain;
      }
    }
  }

 private:
  bool is_left_out(Role role) const { return options_.held_out_only && role != Role::held_out; }

  void add(const Recording& recording, const Experiment& experiment, const std::string& name,
           Played& played) {
    played.trials.push_back(trial_of(recording, experiment, bare_, noise_));
    played.trials.back().name = played.trials.back().file = name;
    if (experiment.role == Role::held_out && !one_.rows.empty()) {
      played.visible = std::max(played.visible, visibility(recording, without_, stated(bare_)));
    }
  }

  const Case& one_;
  const model::Model& bare_;
  Rig without_, with_;
  PlayOptions options_;
  std::mt19937_64 noise_;
};

}  // namespace

std::string why_not(const Case& one, bool mujoco) {
  if (!has_rig(one.robot)) {
    return "no foreign world has the robot " + one.robot;
  }
  if (mujoco && !robot_of(one).scenario.empty()) {
    return "MuJoCo has no robot that hops under a controller";
  }
  for (const Row& row : one.rows) {
    if (mujoco && is_beyond_mujoco(row.effect)) {
      return "MuJoCo's robots have no states of their own, and no battery";
    }
    if (!is_known(row.effect)) {
      return row.effect == "boom" ? "the foreign worlds are flat: no boom bends their ways"
                                  : "no foreign world has " + row.effect;
    }
  }
  return "";
}

bool can_play(const Case& one, bool mujoco) { return why_not(one, mujoco).empty(); }

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
      take_unusual_shape(effect, draw);
    }
    hide(effect, with);
    played.text += (played.text.empty() ? "" : " ") + text;
  }
  Player player(one, bare, without, with, options);
  robot_of(one).scenario.empty() ? player.experiments(draw, played) : player.hops(draw, played);
  return played;
}

}  // namespace plumbline::battery::worlds
