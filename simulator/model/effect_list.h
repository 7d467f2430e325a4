// The effects of a model file: which law, where, with which values.
#pragma once

#include <string>
#include <vector>

#include "simulator/effects/catalogue.h"
#include "simulator/model/model.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::model {

/// Appends the effects of a list {effect, at, values} to the model. Parameters left out take their null
/// values, structural ones the value of the law's first start. Throws InputError on unknown effects, places
/// and parameters (with the nearest names), wrong units, values outside the law's bounds, the same use twice.
void read_effects(const YamlNode& list, const effects::Catalogue& catalogue, Model& model);

/// Replaces values by a map {"viscous@mLA:damping": quantity}. When an effect sits twice at one place, the
/// second is "hard_stop@knee#2:position". What is replaced is independent of all other values.
void replace_values(const YamlNode& map, Model& model);

/// The value of that name; null: the model has none.
const Quantity* find_value(const Model& model, const std::string& name);
std::vector<std::string> value_names(const Model& model);

/// The unit of a law's parameter at a place of a model.
std::string parameter_unit(const Model& model, const effects::Law& law, const std::string& at, int parameter);

}  // namespace plumbline::model
