// Laws that no catalogue has and that the simulator under test cannot play: only the foreign worlds do.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::battery {

/// Declared so that a case can be drawn; their equations are in worlds/outside.cpp.
std::vector<std::shared_ptr<const effects::Law>> told_laws();

/// Is it one of them?
bool is_told(const std::string& effect);

}  // namespace plumbline::battery
