// The list of all laws of the ground that the program knows: explicit, in one place.
#pragma once

#include <memory>
#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::contact {

std::vector<std::shared_ptr<const effects::Law>> ground_laws();

}  // namespace plumbline::contact
