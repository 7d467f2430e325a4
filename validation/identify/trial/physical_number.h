// Numbers with units in trial and experiment files. Unlike a robot's values they need no source.
#pragma once

#include <string>

#include "simulator/model/yaml_node.h"

namespace plumbline::validation {

/// Factor to SI of a unit written in a file. Throws InputError at `where` when the unit is unknown or has not
/// the dimension of `expected`; `owner` says whose unit is expected ("sensor q"). Counts are no angle: a unit
/// like "count" is refused although it has no dimension either.
double unit_factor(const std::string& unit, const std::string& expected, const std::string& owner,
                   const Place_in_file& where);

/// `{value: 4, unit: s}`, with `source` or `assumed` if the writer likes; in SI.
double read_physical(const model::YamlNode& node, const std::string& expected_unit, const std::string& owner);

/// `0.5 Hz`: number, blank, unit; in SI.
double read_physical_text(const model::YamlNode& node, const std::string& expected_unit,
                          const std::string& owner);

/// "rad" or "m".
std::string position_unit(bool angular);

}  // namespace plumbline::validation
