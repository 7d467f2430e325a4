// Further laws that no catalogue has, each a formula of a place's motion or of a motor's command.
#pragma once

#include <memory>
#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::battery {

std::vector<std::shared_ptr<const effects::Law>> foreign_formulas();

}  // namespace plumbline::battery
