// The steps of a recipe, and names that a recipe's parts use.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "simulator/model/yaml_node.h"
#include "validation/studies/recipes/recipe.h"

namespace plumbline::validation {

std::vector<std::string> names_of(const std::vector<Unknown>& unknowns);

/// The node's text, which must be one of the names; otherwise it is refused with the nearest.
std::string known_name(const model::YamlNode& node, const std::vector<std::string>& names,
                       const std::string& kind);

/// Path relative to the file in which it stands; it must be there.
std::string existing_file(const model::YamlNode& node);

/// `given`: what earlier steps carry on; what this one carries on is added.
Step read_step(const model::YamlNode& node, const Recipe& recipe, std::set<std::string>& given);

}  // namespace plumbline::validation
