// What is left when nothing in the catalogue helps: the unexplained generalised force, and what it follows.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/diagnose/dependence.h"
#include "validation/identify/diagnose/diagnose.h"

namespace plumbline::validation {

struct UnexplainedForce {
  std::string trial, at, unit;  ///< at: motor or force plate
  std::string of{};  ///< coordinate whose motion the force was held against; empty: the motor's own
  Role role = Role::train;
  double rms = 0.0;       ///< recorded minus needed (measured minus predicted) force
  double relative = 0.0;  ///< rms / rms of the recorded force
  double sensors = 0.0;   ///< rms that the sensors' floors alone make of a motor's force; 0: a plate's
  double below = 0.0;     ///< Hz: of a motor's force what is below; 0: all of it (a plate's)
  std::vector<Dependence> dependences;  ///< strongest first
  std::string words;                    ///< the strongest dependence in words
};

/// Of the stage's model with the values that were fitted. For every trial and motor for which the inverse
/// model exists (no hidden states, every position measured): recorded minus needed force (inverse_model),
/// low-passed, about its mean; where the sensors' floors alone make most of it, no dependence is named
/// (force_floors). For every force plate: measured minus predicted force while a foot is on the
/// ground (throughout, where no contact switch shows that), against the predicted motion of the coordinate
/// that it follows best, and against the predicted force as its load.
std::vector<UnexplainedForce> unexplained_forces(const Stage& stage, const Data& data);

}  // namespace plumbline::validation
