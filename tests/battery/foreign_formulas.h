// Laws that no catalogue has, each a formula of a place's motion or of a motor's command:
// what a diagnosis must call unexplained.
#pragma once

#include <memory>
#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::battery {

std::vector<std::shared_ptr<const effects::Law>> foreign_laws();

}  // namespace plumbline::battery
