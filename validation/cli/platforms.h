// --platform: what stands on the floor.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <vector>

#include "contact/terrain.h"

namespace plumbline::cli {

/// From, to and height of each, m.
using Platforms = std::vector<std::array<double, 3>>;

/// The floor at height 0 with these platforms. Throws InputError when one is impossible.
contact::Terrain terrain_of(const Platforms& platforms);

}  // namespace plumbline::cli
