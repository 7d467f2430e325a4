// Every effect that a robot file may name: the catalogue and the laws of the ground.
#pragma once

#include "simulator/effects/catalogue.h"

namespace plumbline::model {

effects::Catalogue known_effects();

}  // namespace plumbline::model
