// The account of a Plant's energy: what is stored, what comes in, what goes.
#pragma once

#include "simulator/model/plant_dynamics.h"
#include "simulator/model/plant_values.h"

namespace plumbline::model {

/// At a state and command, with the rigid bodies' share of what is stored.
Energetics energetics(PlantDynamics& plant, const double* x, const double* command);
/// For the state and command that PlantDynamics::rate() was last called with, without the rigid bodies'
/// share. What bristles take is booked as it goes: the energy in them scales with the load and leaves with
/// it.
Energetics powers(const PlantDynamics& plant, const double* x);

}  // namespace plumbline::model
