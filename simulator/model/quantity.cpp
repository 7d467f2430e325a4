#include "simulator/model/quantity.h"

#include <cmath>

#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"

namespace plumbline::model {
namespace {

using Sign = QuantityRule::Sign;

double read_unit(const YamlNode& node, const std::string& expected) {
  const std::string unit = node.text();
  if (!unit_is_known(unit)) {
    node.refuse("unknown unit " + quote(unit), "a unit like " + quote(expected));
  }
  if (!units_agree(unit, expected)) {
    node.refuse("unit " + quote(unit), "a unit like " + quote(expected));
  }
  return to_si_factor(unit);
}

void check_sign(const YamlNode& node, double value, Sign sign) {
  switch (sign) {
    case Sign::any:
      return;
    case Sign::not_zero:
      return value != 0.0 ? void() : node.refuse("a number that is not zero");
    case Sign::not_negative:
      return value >= 0.0 ? void() : node.refuse("a number that is not negative");
    case Sign::positive:
      return value > 0.0 ? void() : node.refuse("a number above zero");
  }
}

double to_si(const YamlNode& node, double value, double factor) {
  const double si = value * factor;
  if (std::isinf(si) && !std::isinf(value)) {
    node.refuse("a finite number in SI");
  }
  if (si == 0.0 && value != 0.0) {
    node.refuse("a number that is not lost in SI");
  }
  return si;
}

}  // namespace

Origin read_origin(const YamlNode& node) {
  const auto source = node.find("source");
  const auto assumed = node.find("assumed");
  if (source && assumed) {
    assumed->refuse("both source and assumed", "one of them");
  }
  if (!source && !assumed) {
    node.refuse("no source", "`source: text`, or `assumed: reason` when no source gives the value");
  }
  return source ? Origin{source->text(), false} : Origin{assumed->text(), true};
}

double read_uncertainty(const YamlNode& node, double value, double si_factor) {
  std::string text = node.text();
  double scale = si_factor;
  if (text.back() == '%') {
    text.pop_back();
    text.erase(text.find_last_not_of(" \t") + 1);
    scale = 0.01 * std::abs(value);
  }
  const std::optional<double> number = parse_number(text);
  if (!number || *number < 0.0) {
    node.refuse("a number that is not negative, in the value's unit, or a percentage such as 5 %");
  }
  const double uncertainty = *number * scale;
  if (!std::isfinite(uncertainty)) {
    node.refuse("a finite uncertainty of a finite value");
  }
  return uncertainty;
}

Quantity read_quantity(const YamlNode& node, const QuantityRule& rule) {
  if (!node.is_map()) {
    node.refuse("a map {value: ..., unit: " + rule.unit + ", source: ...}");
  }
  std::vector<std::string> known{"value", "unit", "uncertainty", "source", "assumed"};
  known.insert(known.end(), rule.extra_keys.begin(), rule.extra_keys.end());
  node.allow_keys(known);
  const YamlNode value = node.at("value");
  const double written = rule.infinity ? value.number_or_infinity() : value.number();
  const double factor = read_unit(node.at("unit"), rule.unit);
  check_sign(value, written, rule.sign);
  const Origin origin = read_origin(node);

  Quantity quantity;
  quantity.value = to_si(value, written, factor);
  quantity.unit = node.at("unit").text();
  quantity.source = origin.text;
  quantity.assumed = origin.assumed;
  quantity.line = node.line();
  if (const auto uncertainty = node.find("uncertainty")) {
    quantity.uncertainty = read_uncertainty(*uncertainty, quantity.value, factor);
  }
  return quantity;
}

}  // namespace plumbline::model
