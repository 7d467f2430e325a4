// Laws that no catalogue has, where a robot with such a law hidden in it looks for them.
#pragma once

#include "simulator/effects/catalogue.h"
#include "simulator/model/model.h"

namespace plumbline::battery {

/// The laws that robot files know, and those of foreign_formulas.h and foreign_told.h.
effects::Catalogue every_law();

/// The model with a coordinate `toe_height` where it is the hopper, for a law of the ground that changes in
/// time.
model::Model with_foreign_places(model::Model model);

}  // namespace plumbline::battery
