// A case of the battery played in a foreign world: what its sensors record, and how far the hidden effect can
// be seen in it at best.
#pragma once

#include <string>
#include <vector>

#include "tests/battery/draw.h"
#include "tests/battery/worlds/hidden.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::battery::worlds {

struct PlayOptions {
  std::uint64_t seed = 1;
  bool held_out_only = false;
  bool as_stated = false;  ///< the stated numbers exactly as stated
  bool lab = false;     ///< numbers without a stated uncertainty scattered, too; unusual constants of shape
  bool mujoco = false;  ///< rigid bodies, friction, stops and integration by MuJoCo
};

struct Played {
  std::vector<validation::Trial> trials;
  std::string text;  ///< what is hidden
  /// Held-out error of the true robot without what is hidden, its windows' beginnings and its stated numbers
  /// (at what is stated of them) fitted to the true motion: 1 where it changes nothing that a sensor shows.
  double visible = 1.0;
};

/// Why no foreign world (with `mujoco`: not MuJoCo) plays the case; empty: one does.
std::string why_not(const Case& one, bool mujoco = false);
bool can_play(const Case& one, bool mujoco = false);

/// `hidden`: the drawn effects as text, "coulomb@mLA:level=...". Throws what read_experiment throws.
Played play(const Case& one, const model::Model& bare, const std::vector<std::string>& hidden, Draw& draw,
            const PlayOptions& options);

}  // namespace plumbline::battery::worlds
