#include "simulator/model/effect_list.h"

#include <algorithm>
#include <cmath>

#include "simulator/effects/supply_law.h"
#include "simulator/model/places.h"
#include "simulator/model/quantity.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"

namespace plumbline::model {
namespace {

std::vector<std::string> parameter_names(const effects::Law& law) {
  std::vector<std::string> names;
  for (const effects::Parameter& parameter : law.declaration().parameters) {
    names.push_back(parameter.name);
  }
  return names;
}

/// What a law takes when the file says nothing.
std::vector<Quantity> default_values(const Model& model, const effects::Law& law, const std::string& at,
                                     int line) {
  const std::vector<effects::Values> starts = law.starts(effects::Scales{});
  std::vector<Quantity> values;
  for (int i = 0; i < law.parameter_count(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const effects::Parameter& parameter = law.declaration().parameters[index];
    const bool from_start = parameter.structural && !starts.empty() && index < starts.front().size();
    Quantity quantity;
    quantity.value = from_start ? starts.front()[index] : parameter.null_value;
    quantity.unit = parameter_unit(model, law, at, i);
    quantity.source = from_start ? "the law's usual value" : "null value: changes nothing";
    quantity.assumed = true;
    quantity.line = line;
    values.push_back(std::move(quantity));
  }
  return values;
}

void check_bounds(const YamlNode& node, const effects::Parameter& parameter, const Quantity& quantity) {
  if (quantity.value < parameter.lower || quantity.value > parameter.upper) {
    node.refuse(number_text(quantity.value) + " (SI)", "a value from " + number_text(parameter.lower) +
                                                           " to " + number_text(parameter.upper) + " (SI)");
  }
}

Quantity read_parameter(const YamlNode& node, const Model& model, const EffectUse& use, int index) {
  const effects::Parameter& parameter = use.law->declaration().parameters[static_cast<std::size_t>(index)];
  QuantityRule rule;
  rule.unit = parameter_unit(model, *use.law, use.at, index);
  rule.infinity = std::isinf(parameter.null_value);
  Quantity quantity = read_quantity(node, rule);
  check_bounds(node.at("value"), parameter, quantity);
  return quantity;
}

bool same_structure(const EffectUse& a, const EffectUse& b) {
  const std::vector<effects::Parameter>& parameters = a.law->declaration().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].structural && a.values[i].value != b.values[i].value) {
      return false;
    }
  }
  return true;
}

bool same_place(const EffectUse& a, const EffectUse& b) {
  return a.law->declaration().name == b.law->declaration().name && a.at == b.at;
}

/// Is the effect meant to sit at its place beside one of its kind?
bool is_again(const YamlNode& node) {
  const auto again = node.find("again");
  if (again && again->text() != "true") {
    again->refuse(quote(again->text()), "true, or no such key");
  }
  return again.has_value();
}

void refuse_repetition(const YamlNode& node, const EffectUse& use, const Model& model) {
  if (is_again(node)) {
    return;
  }
  for (const EffectUse& other : model.effects) {
    if (same_place(use, other) && same_structure(use, other)) {
      node.refuse(use.label() + " twice",
                  "each effect once at a place, unless structural values differ or it says \"again: true\"");
    }
  }
}

EffectUse read_effect(const YamlNode& node, const effects::Catalogue& catalogue, const Model& model) {
  node.allow_keys({"effect", "at", "again", "values"});
  const YamlNode name = node.at("effect");
  EffectUse use;
  use.law = catalogue.find(name.text());
  if (use.law == nullptr) {
    std::vector<std::string> known;
    for (const auto& law : catalogue.laws()) {
      known.push_back(law->declaration().name);
    }
    name.refuse(quote(name.text()), "an effect of the catalogue" + nearest_names(name.text(), known));
  }
  const YamlNode at = node.at("at");
  use.at = at.text();
  if (!find_place(model, *use.law, use.at)) {
    at.refuse(quote(use.at), expected_place(model, *use.law, use.at));
  }
  if (dynamic_cast<const effects::SupplyLaw*>(use.law.get()) != nullptr && model.motors.empty()) {
    name.refuse(quote(name.text()) + " of a robot without a motor", "a motor that draws on it");
  }
  use.line = node.line();
  use.values = default_values(model, *use.law, use.at, use.line);
  if (const auto values = node.find("values")) {
    for (const auto& [parameter, quantity] : values->entries()) {
      const int index = use.law->parameter_index(parameter);
      if (index < 0) {
        quantity.refuse("an unknown parameter", "a parameter of " + use.law->declaration().name +
                                                    nearest_names(parameter, parameter_names(*use.law)));
      }
      use.values[static_cast<std::size_t>(index)] = read_parameter(quantity, model, use, index);
    }
  }
  return use;
}

/// A parameter of the model by its name in an overlay.
struct NamedParameter {
  std::string name;
  std::size_t effect = 0;
  int parameter = 0;
};

std::vector<NamedParameter> named_parameters(const Model& model) {
  std::vector<NamedParameter> named;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const EffectUse& use = model.effects[e];
    int number = 1;
    for (std::size_t before = 0; before < e; ++before) {
      number += same_place(model.effects[before], use) ? 1 : 0;
    }
    const std::string which = number == 1 ? "" : "#" + std::to_string(number);
    const std::string label = use.law->declaration().name + "@" + use.at + which + ":";
    for (int p = 0; p < use.law->parameter_count(); ++p) {
      named.push_back({label + use.law->declaration().parameters[static_cast<std::size_t>(p)].name, e, p});
    }
  }
  return named;
}

}  // namespace

std::string parameter_unit(const Model& model, const effects::Law& law, const std::string& at,
                           int parameter) {
  const std::optional<effects::Place> place = find_place(model, law, at);
  const bool angular = !place || model.place_is_angular(*place, at);
  return effects::unit_at(law.declaration().parameters[static_cast<std::size_t>(parameter)].unit, angular);
}

void read_effects(const YamlNode& list, const effects::Catalogue& catalogue, Model& model) {
  for (const YamlNode& item : list.items()) {
    EffectUse use = read_effect(item, catalogue, model);
    refuse_repetition(item, use, model);
    model.effects.push_back(std::move(use));
  }
}

const Quantity* find_value(const Model& model, const std::string& name) {
  for (const NamedParameter& known : named_parameters(model)) {
    if (known.name == name) {
      return &model.effects[known.effect].values[static_cast<std::size_t>(known.parameter)];
    }
  }
  return nullptr;
}

std::vector<std::string> value_names(const Model& model) {
  std::vector<std::string> names;
  for (const NamedParameter& known : named_parameters(model)) {
    names.push_back(known.name);
  }
  return names;
}

void replace_values(const YamlNode& map, Model& model) {
  const std::vector<NamedParameter> named = named_parameters(model);
  std::vector<std::string> replaced;
  for (const auto& [key, quantity] : map.entries()) {
    const std::string& wanted = key;
    const auto found = std::find_if(named.begin(), named.end(),
                                    [&](const NamedParameter& known) { return known.name == wanted; });
    if (found == named.end()) {
      quantity.refuse("an unknown value",
                      "effect@place:parameter of the model" + nearest_names(key, value_names(model)));
    }
    EffectUse& use = model.effects[found->effect];
    use.values[static_cast<std::size_t>(found->parameter)] =
        read_parameter(quantity, model, use, found->parameter);
    replaced.push_back(key);
  }
  model.correlations = model.correlations.without(replaced);  // they hung together as they were known before
}

}  // namespace plumbline::model
