// recipe.yaml -> Recipe.
#include <algorithm>
#include <filesystem>
#include <set>

#include "simulator/model/quantity.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/yaml_node.h"
#include "simulator/trace/units.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/trial/trial_file.h"
#include "validation/studies/recipes/recipe.h"
#include "validation/studies/recipes/step_file.h"

namespace plumbline::validation {
namespace {

using model::QuantityRule;
using model::YamlNode;
using Sign = QuantityRule::Sign;

/// `1 %` of the true value, or a number in the unknown's unit.
Target read_target(const YamlNode& node, double factor) {
  const std::string text = node.text();
  Target target;
  target.relative = text.back() == '%';
  target.size = model::read_uncertainty(node, 1.0, target.relative ? 1.0 : factor);
  if (!(target.size > 0.0)) {
    node.refuse("a number above zero, in the unknown's unit, or a percentage such as 1 %");
  }
  return target;
}

Unknown read_unknown(const std::string& name, const YamlNode& node) {
  node.allow_keys({"title", "unit", "stated", "target"});
  Unknown unknown;
  unknown.name = name;
  unknown.title = node.at("title").text();
  unknown.unit = node.at("unit").text();
  if (!unit_is_known(unknown.unit)) {
    node.at("unit").refuse("a unit such as N m or 1");
  }
  if (const auto stated = node.find("stated")) {
    const model::Quantity quantity = model::read_quantity(*stated, {unknown.unit, Sign::any, false, {}});
    unknown.stated = true;
    unknown.value = quantity.value;
    unknown.deviation = quantity.uncertainty;
  }
  if (const auto target = node.find("target")) {
    unknown.target = read_target(*target, to_si_factor(unknown.unit));
  }
  return unknown;
}

/// The unknown must have the parameter's unit, or be a pure number that `times` gives the unit.
void check_link_units(const YamlNode& node, const Unknown& unknown, const std::string& unit,
                      const Link& link) {
  const bool pure = units_agree(unknown.unit, "1");
  if (link.power == -1 && !pure) {
    node.at("power").refuse("power -1 of an unknown in " + unknown.unit, "a pure number");
  }
  if (node.is_map() && node.has("times") && !pure) {
    node.at("times").refuse("a factor for an unknown in " + unknown.unit,
                            "none, or an unknown that is a pure number");
  }
  const bool scaled = node.is_map() && node.has("times");
  if (!scaled && !units_agree(unknown.unit, unit)) {
    node.refuse("unknown " + model::quote(unknown.name) + " in " + unknown.unit, "a unit like " + unit);
  }
}

Link read_link(const FreeParameter& parameter, const YamlNode& node, const std::vector<Unknown>& unknowns) {
  Link link;
  link.label = parameter.label;
  link.place = node.place();
  const YamlNode name = node.is_map() ? node.at("unknown") : node;
  link.unknown = known_name(name, names_of(unknowns), "unknown");
  if (node.is_map()) {
    node.allow_keys({"unknown", "times", "power", "plus"});
    if (const auto times = node.find("times")) {
      link.times = model::read_quantity(*times, {parameter.unit, Sign::not_zero, false, {}}).value;
    }
    if (const auto plus = node.find("plus")) {
      link.plus = model::read_quantity(*plus, {parameter.unit, Sign::any, false, {}}).value;
    }
    if (const auto power = node.find("power")) {
      if (power->number() != 1.0 && power->number() != -1.0) {
        power->refuse("1 or -1");
      }
      link.power = static_cast<int>(power->number());
    }
  }
  const auto unknown = std::find_if(unknowns.begin(), unknowns.end(),
                                    [&](const Unknown& one) { return one.name == link.unknown; });
  check_link_units(node, *unknown, parameter.unit, link);
  return link;
}

LinkedModel read_linked_model(const std::string& name, const YamlNode& node,
                              const std::vector<Unknown>& unknowns, const effects::Catalogue& catalogue) {
  node.allow_keys({"file", "links"});
  LinkedModel linked;
  linked.name = name;
  linked.file = existing_file(node.at("file"));
  linked.model = model::read_model(linked.file, catalogue);
  const std::vector<FreeParameter> parameters = free_parameters(linked.model);
  std::vector<std::string> labels;
  labels.reserve(parameters.size());
  for (const FreeParameter& parameter : parameters) {
    labels.push_back(parameter.label);
  }
  for (const auto& [label, entry] : node.at("links").entries()) {
    const auto parameter =
        std::find_if(parameters.begin(), parameters.end(),
                     [&, wanted = label](const FreeParameter& one) { return one.label == wanted; });
    if (parameter == parameters.end()) {
      entry.refuse(model::quote(label), "a parameter of " + linked.file + nearest_names(label, labels));
    }
    linked.links.push_back(read_link(*parameter, entry, unknowns));
  }
  return linked;
}

}  // namespace

Recipe read_recipe(const std::string& path, const effects::Catalogue& catalogue) {
  namespace fs = std::filesystem;
  const std::string file = fs::is_directory(path) ? (fs::path(path) / "recipe.yaml").string() : path;
  const YamlNode root = YamlNode::load(file);
  check_format(root, "recipe/1");
  root.allow_keys({"plumbline", "title", "source", "unknowns", "models", "steps"});
  Recipe recipe;
  recipe.file = file;
  recipe.title = root.at("title").text();
  for (const auto& [name, node] : root.at("unknowns").entries()) {
    recipe.unknowns.push_back(read_unknown(name, node));
  }
  for (const auto& [name, node] : root.at("models").entries()) {
    recipe.models.push_back(read_linked_model(name, node, recipe.unknowns, catalogue));
  }
  std::set<std::string> given;
  for (const YamlNode& node : root.at("steps").items()) {
    recipe.steps.push_back(read_step(node, recipe, given));
  }
  if (recipe.steps.empty()) {
    root.at("steps").refuse("an empty list", "at least one step");
  }
  return recipe;
}

}  // namespace plumbline::validation
