// The account of a Plant's energy: what is stored, what comes in, what goes.
#pragma once

#include "simulator/model/plant_dynamics.h"
#include "simulator/model/plant_values.h"

namespace plumbline::model {

/// As those of Plant.
Energetics energetics(PlantDynamics& plant, const double* x, const double* command);
Energetics powers(const PlantDynamics& plant, const double* x);

}  // namespace plumbline::model
