#include "validation/identify/closed_loop/reference.h"

#include <array>
#include <filesystem>

#include "simulator/model/quantity.h"
#include "validation/identify/trial/trial_file.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;
using Quantity = ReferenceValue::Quantity;

constexpr std::array<Quantity, 3> kQuantities{Quantity::closed_loop_position, Quantity::closed_loop_force,
                                              Quantity::inverse_force};

Quantity read_kind(const model::YamlNode& node) {
  std::vector<std::string> known;
  for (const Quantity quantity : kQuantities) {
    known.push_back(to_string(quantity));
    if (known.back() == node.text()) {
      return quantity;
    }
  }
  node.refuse("closed_loop_position, closed_loop_force or inverse_force" + nearest_names(node.text(), known));
}

ReferenceValue read_value(const model::YamlNode& node) {
  const model::Quantity number = model::read_quantity(
      node, {"%", model::QuantityRule::Sign::not_negative, false, {"compares", "model", "data"}});
  ReferenceValue value;
  value.quantity = read_kind(node.at("compares"));
  value.model = node.at("model").text();
  value.data = node.at("data").text();
  value.percent = 100.0 * number.value;
  value.source = number.source;
  return value;
}

}  // namespace

std::string to_string(ReferenceValue::Quantity quantity) {
  switch (quantity) {
    case Quantity::closed_loop_position:
      return "closed_loop_position";
    case Quantity::closed_loop_force:
      return "closed_loop_force";
    case Quantity::inverse_force:
      break;
  }
  return "inverse_force";
}

std::vector<ReferenceValue> read_reference(const std::string& path) {
  const model::YamlNode root = model::YamlNode::load(path);
  check_format(root, "reference/1");
  root.allow_keys({"plumbline", "values"});
  std::vector<ReferenceValue> values;
  for (const model::YamlNode& node : root.at("values").items()) {
    values.push_back(read_value(node));
  }
  return values;
}

std::string reference_beside(const std::string& model_file) {
  const fs::path path = fs::path(model_file).parent_path() / "reference.yaml";
  std::error_code none;
  return fs::is_regular_file(path, none) ? path.string() : "";
}

}  // namespace plumbline::validation
