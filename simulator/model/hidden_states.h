// Hidden states of a Plant: which the past determines, and what it makes of them.
#pragma once

#include <vector>

#include "simulator/model/plant_dynamics.h"

namespace plumbline::model {

/// As those of Plant.
std::vector<int> carried_states(const PlantDynamics& plant);
std::vector<int> carried_state_effects(const PlantDynamics& plant);
void carry_states(PlantDynamics& plant, const double* from, const double* to, const double* command, double h,
                  double* x);
void settle(const PlantDynamics& plant, const double* command, double* x);

}  // namespace plumbline::model
