// What is left when nothing in the catalogue helps: the unexplained generalised force, and what it follows.
#pragma once

#include <string>
#include <vector>

#include "validation/diagnose/dependence.h"
#include "validation/diagnose/diagnose.h"

namespace plumbline::validation {

struct UnexplainedForce {
  std::string trial, motor, unit;
  Role role = Role::train;
  double rms = 0.0;                     ///< recorded minus needed force, low-passed
  double relative = 0.0;                ///< rms / rms of the recorded force
  std::vector<Dependence> dependences;  ///< strongest first
  std::string words;                    ///< the strongest dependence in words
};

/// For every trial and motor for which the inverse model exists (no hidden states, every position measured).
/// The force is recorded minus needed (inverse_model), about its mean.
std::vector<UnexplainedForce> unexplained_forces(const model::Model& model, const Data& data);

}  // namespace plumbline::validation
