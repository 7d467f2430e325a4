// Terrain in scenario and trial files.
#pragma once

#include "contact/terrain.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::model {

/// `{floor: 0 m, platforms: [{from: .., to: .., height: ..}, ...]}` each number `{value: .., unit: m}`.
/// Throws InputError.
contact::Terrain read_terrain(const YamlNode& node);

}  // namespace plumbline::model
