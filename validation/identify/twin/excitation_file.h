// Excitations as experiment.yaml writes them.
#pragma once

#include "simulator/model/yaml_node.h"
#include "validation/identify/twin/excitation.h"

namespace plumbline::validation {

/// The list of shapes of one motor, whose command has `command_unit`; levels come out in SI. Throws
/// InputError with line and key.
Excitations read_excitations(const model::YamlNode& list, const std::string& command_unit,
                             const std::string& motor, const Sampling& sampling);

}  // namespace plumbline::validation
