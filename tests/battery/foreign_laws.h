// Laws that no catalogue has: what a diagnosis must call unexplained.
#pragma once

#include "simulator/effects/catalogue.h"
#include "simulator/model/model.h"

namespace plumbline::battery {

/// fading_ground: at a foot's height over the ground; the elastic force of a ground of this stiffness wears
/// off by `share` within `time`. warming_friction: friction that grows with the heat it makes.
/// rail_magnets: a force that repeats along the way. And those of foreign_formulas.h.
std::vector<std::shared_ptr<const effects::Law>> foreign_laws();

/// The laws that robot files know, and these.
effects::Catalogue every_law();

/// The model with a coordinate `toe_height` where it is the hopper, for a law of the ground that changes in
/// time.
model::Model with_foreign_places(model::Model model);

}  // namespace plumbline::battery
