#include "simulator/model/plain_number.h"

#include <cmath>

#include "simulator/model/kinds.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"

namespace plumbline::model {

double read_number(const YamlNode& node, const std::string& unit, const std::vector<std::string>& others) {
  if (!node.is_map()) {
    node.refuse("a map {value: ..., unit: " + unit + "}");
  }
  std::vector<std::string> keys{"value", "unit", "source", "assumed"};
  keys.insert(keys.end(), others.begin(), others.end());
  node.allow_keys(keys);
  const YamlNode written = node.at("unit");
  const std::string text = written.text();
  if (!unit_is_known(text) || !units_agree(text, unit) || text.find("count") != std::string::npos) {
    written.refuse("a unit like " + quote(unit));
  }
  const double value = node.at("value").number() * to_si_factor(text);
  if (!std::isfinite(value)) {
    node.at("value").refuse("a finite number in SI");
  }
  return value;
}

double read_positive(const YamlNode& node, const std::string& unit, const std::vector<std::string>& others) {
  const double value = read_number(node, unit, others);
  if (!(value > 0.0)) {
    node.at("value").refuse(number_text(value), "a number above zero");
  }
  return value;
}

std::string position_unit_of(const Model& model, const std::string& name, const YamlNode& node) {
  std::vector<std::string> known = position_names(model);
  for (const std::string& joint : joint_names(model.skeleton)) {
    known.push_back(joint);
  }
  for (const std::string& one : known) {
    if (one == name) {
      return position_unit(is_angular(model, name));
    }
  }
  node.refuse(quote(name), "a coordinate, motor, pulley or joint of the model" + nearest_names(name, known));
}

}  // namespace plumbline::model
