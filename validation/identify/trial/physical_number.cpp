#include "validation/identify/trial/physical_number.h"

#include <cmath>
#include <optional>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"

namespace plumbline::validation {
namespace {

double finite(const model::YamlNode& node, double value) {
  if (!std::isfinite(value)) {
    node.refuse("a finite number in SI");
  }
  return value;
}

}  // namespace

double unit_factor(const std::string& unit, const std::string& expected, const std::string& owner,
                   const Place_in_file& where) {
  const std::string wanted = "a unit like " + model::quote(expected) + ", which " + owner + " has";
  if (!unit_is_known(unit)) {
    throw InputError(where, "unknown unit " + model::quote(unit), wanted);
  }
  if (unit.find("count") != std::string::npos) {
    throw InputError(where, "unit " + model::quote(unit),
                     wanted + "; multiply counts by the sensor's resolution first");
  }
  if (!units_agree(unit, expected)) {
    throw InputError(where, "unit " + model::quote(unit), wanted);
  }
  return to_si_factor(unit);
}

double read_physical(const model::YamlNode& node, const std::string& expected_unit,
                     const std::string& owner) {
  if (!node.is_map()) {
    node.refuse("a map {value: ..., unit: " + expected_unit + "}");
  }
  node.allow_keys({"value", "unit", "source", "assumed"});
  const model::YamlNode unit = node.at("unit");
  const model::YamlNode value = node.at("value");
  return finite(value, value.number() * unit_factor(unit.text(), expected_unit, owner, unit.place()));
}

double read_physical_text(const model::YamlNode& node, const std::string& expected_unit,
                          const std::string& owner) {
  const std::string text = node.text();
  const std::size_t blank = text.find(' ');
  const std::optional<double> value = parse_number(text.substr(0, blank));
  const std::size_t unit = text.find_first_not_of(' ', blank);
  if (!value || blank == std::string::npos || unit == std::string::npos) {
    node.refuse("a number and its unit, such as " + model::quote("0.5 " + expected_unit));
  }
  return finite(node, *value * unit_factor(text.substr(unit), expected_unit, owner, node.place()));
}

std::string position_unit(bool angular) { return angular ? "rad" : "m"; }

}  // namespace plumbline::validation
