// Numbers with units that need no source: of scenarios, trials and wiring.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::model {

/// `{value: 5, unit: cm}`, with `source` or `assumed` if the writer likes; in SI. Throws InputError when the
/// unit has not the dimension of `unit`. `others`: keys of the same map that the caller reads.
double read_number(const YamlNode& node, const std::string& unit,
                   const std::vector<std::string>& others = {});
/// The same, above zero.
double read_positive(const YamlNode& node, const std::string& unit,
                     const std::vector<std::string>& others = {});

/// rad or m of a coordinate, motor, pulley or joint; throws InputError at `node` when the model has none of
/// this name.
std::string position_unit_of(const Model& model, const std::string& name, const YamlNode& node);

}  // namespace plumbline::model
