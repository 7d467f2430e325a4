// Robots like the model, but not quite: how much of a gait hangs on exact values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::validation {

/// `count` copies of a model in which every link's mass (with its inertia about the centre of mass), every
/// motor's torque and every cable's stiffness has a factor of its own, drawn evenly within 1 +- `share`. The
/// torques' factors are torque_constant_error effects.
std::vector<model::Model> draw_models(const model::Model& model, int count, double share, std::uint64_t seed);

/// A drawn motor: `factor` times the torque, as a torque_constant_error effect.
model::EffectUse torque_factor(const std::string& motor, double factor);

}  // namespace plumbline::validation
