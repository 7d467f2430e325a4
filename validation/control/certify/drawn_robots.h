// Robots as the model's stated uncertainties allow them.
#pragma once

#include <cstdint>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::validation {

/// `count` copies in which everything that states an uncertainty is drawn from a normal distribution of that
/// standard deviation, within three of them: masses (inertia about the centre of mass in proportion), rotor
/// inertias, torque constants (as torque_constant_error) and the values of effects. What must be positive
/// stays above a tenth of its value.
std::vector<model::Model> draw_robots(const model::Model& model, int count, std::uint64_t seed);

}  // namespace plumbline::validation
