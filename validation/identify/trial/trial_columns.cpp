#include "validation/identify/trial/trial_columns.h"

#include "simulator/model/yaml_chain.h"
#include "simulator/trace/units.h"
#include "validation/identify/trial/physical_number.h"

namespace plumbline::validation {

using model::Model;
using model::quote;
using model::YamlNode;

namespace {

void read_scale(const YamlNode& node, const std::string& expected_unit, const std::string& owner,
                ColumnUse& use) {
  if (const auto scale = node.find("scale")) {
    use.scale = scale->number();
    if (use.scale == 0.0) {
      scale->refuse("a number that is not zero");
    }
  }
  if (const auto offset = node.find("offset")) {
    use.offset = read_physical(*offset, expected_unit, owner);
  }
}

}  // namespace

void check_sensor(const YamlNode& node, const std::string& name, const Model& model) {
  if (model.find_sensor(name) == nullptr) {
    node.refuse("sensor " + quote(name),
                "a sensor of the model" + nearest_names(name, names_of(model.sensors)));
  }
}

ColumnUse read_named_column(const YamlNode& node, const YamlNode& name, const std::string& expected_unit,
                            const std::string& owner) {
  ColumnUse use;
  use.name = name.text();
  if (const auto topic = node.find("topic")) {
    use.name = topic->text() + "." + use.name;
    use.has_topic = true;
  }
  use.place = name.place();
  use.expected_unit = expected_unit;
  use.owner = owner;
  if (const auto unit = node.find("unit")) {
    use.unit = unit->text();
    unit_factor(use.unit, expected_unit, owner, unit->place());  // refuses a wrong one here
  }
  return use;
}

ColumnUse read_column(const YamlNode& node, const std::string& expected_unit, const std::string& owner,
                      const std::vector<std::string>& further_keys) {
  if (!node.is_map()) {
    node.refuse("a map {column: ..., unit: " + expected_unit + "}");
  }
  std::vector<std::string> keys{"topic", "column", "unit", "scale", "offset"};
  keys.insert(keys.end(), further_keys.begin(), further_keys.end());
  node.allow_keys(keys);
  ColumnUse use = read_named_column(node, node.at("column"), expected_unit, owner);
  read_scale(node, expected_unit, owner, use);
  return use;
}

std::optional<double> read_not_negative(const YamlNode& node, const std::string& key, const std::string& unit,
                                        const std::string& owner) {
  const auto given = node.find(key);
  if (!given) {
    return std::nullopt;
  }
  const double value = read_physical(*given, unit, owner);
  if (value < 0.0) {
    given->refuse("a value below zero", "zero or more");
  }
  return value;
}

void read_wrap(const YamlNode& node, const std::string& expected_unit, const std::string& owner,
               ColumnUse& use) {
  constexpr double kTurn = 6.283185307179586476925286766559;
  const auto unwrap = node.find("unwrap");
  if (!unwrap) {
    return;
  }
  if (unwrap->is_map()) {
    use.turn = read_physical(*unwrap, expected_unit, owner);
  } else if (unwrap->flag()) {
    use.turn = kTurn;
    if (!units_agree(expected_unit, "rad")) {
      unwrap->refuse("true where nothing turns",
                     "after what it wraps: {value: ..., unit: " + expected_unit + "}");
    }
  }
  if (unwrap->is_map() && !(use.turn > 0.0)) {
    unwrap->refuse("a turn that is not above zero", "the range of the column before it begins anew");
  }
}

}  // namespace plumbline::validation
