#include "validation/hopping/published.h"

#include <array>
#include <cmath>

#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;
using Relation = Published::Relation;
using Sign = model::QuantityRule::Sign;

constexpr std::array<Relation, 3> kRelations{Relation::value, Relation::at_most, Relation::at_least};

const Measure* read_measure(const YamlNode& node) {
  const std::string name = node.text();
  const Measure* measure = find_measure(name);
  if (measure == nullptr) {
    std::vector<std::string> known;
    for (const Measure& one : measures()) {
      known.push_back(one.name);
    }
    node.refuse("a known measure" + nearest_names(name, known));
  }
  return measure;
}

Published read_one(const YamlNode& node) {
  node.allow_keys({"name", "measure", "value", "at_most", "at_least", "tolerance"});
  Published published;
  published.name = node.at("name").text();
  published.measure = read_measure(node.at("measure"));
  int given = 0;
  for (const Relation relation : kRelations) {
    if (const auto number = node.find(to_string(relation))) {
      published.relation = relation;
      published.quantity = model::read_quantity(*number, {published.measure->unit, Sign::any, false, {}});
      ++given;
    }
  }
  if (given != 1) {
    node.refuse(std::to_string(given) + " of value, at_most and at_least", "one of them");
  }
  published.tolerance =
      model::read_quantity(node.at("tolerance"), {published.measure->unit, Sign::not_negative, false, {}});
  return published;
}

/// Distance from the value, or beyond the limit (0 on its right side), signed.
double distance(const Published& published, double measured) {
  const double off = measured - published.quantity.value;
  switch (published.relation) {
    case Relation::at_most:
      return std::max(0.0, off);
    case Relation::at_least:
      return std::min(0.0, off);
    case Relation::value:
      break;
  }
  return off;
}

}  // namespace

double Published::outside(double measured) const {
  const double off = distance(*this, measured);
  return std::copysign(std::max(0.0, std::abs(off) - tolerance.value), off);
}

double Published::deviation(double measured) const { return distance(*this, measured) / tolerance.value; }

std::string to_string(Relation relation) {
  switch (relation) {
    case Relation::at_most:
      return "at_most";
    case Relation::at_least:
      return "at_least";
    case Relation::value:
      break;
  }
  return "value";
}

PublishedRobot read_published(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  check_format(root, "published/1");
  root.allow_keys({"plumbline", "title", "model", "controller", "tuned_rigid", "quantities"});
  const auto beside = [](const YamlNode& node) { return model::beside(node.file(), node.text()); };
  PublishedRobot robot;
  robot.model = beside(root.at("model"));
  robot.controller = beside(root.at("controller"));
  if (const auto tuned_rigid = root.find("tuned_rigid")) {
    robot.tuned_rigid = beside(*tuned_rigid);
  }
  for (const YamlNode& node : root.at("quantities").items()) {
    robot.quantities.push_back(read_one(node));
  }
  if (robot.quantities.empty()) {
    root.at("quantities").refuse("an empty list", "at least one quantity");
  }
  return robot;
}

}  // namespace plumbline::validation
