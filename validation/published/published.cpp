#include "validation/published/published.h"

#include <array>
#include <cmath>

#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "simulator/trace/units.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;
using Relation = PublishedQuantity::Relation;
using Sign = model::QuantityRule::Sign;

constexpr std::array<Relation, 3> kRelations{Relation::value, Relation::at_most, Relation::at_least};

std::string resolved(const YamlNode& node) { return model::beside(node.file(), node.text()); }

/// The unit of a measure; its channels must be there.
std::string unit_on(const run::LoadedScenario& loaded, const Measure& measure, const YamlNode& node) {
  if (measure.of() == Measure::Of::model) {
    if (loaded.model.find_ratio(measure.channels.front()) == nullptr) {
      node.refuse(model::quote(measure.channels.front()),
                  "a ratio of the model" +
                      nearest_names(measure.channels.front(), loaded.model.places(effects::Place::ratio)));
    }
    return "1";
  }
  return unit_of(measure, Channels(loaded, measure.channels, node.place()), node.place());
}

PublishedQuantity read_one(const YamlNode& node, const run::LoadedScenario& loaded,
                           const std::optional<Section>& section) {
  node.allow_keys({"name", "measure", "value", "at_most", "at_least", "tolerance", "over", "controller"});
  PublishedQuantity published;
  published.name = node.at("name").text();
  published.measure = read_measure(node.at("measure"));
  published.unit = unit_on(loaded, published.measure, node.at("measure"));
  if (published.measure.of() == Measure::Of::orbit && !section) {
    node.at("measure").refuse(published.measure.text,
                              "a gait whose scenario has a section for the return map");
  }
  int given = 0;
  for (const Relation relation : kRelations) {
    if (const auto number = node.find(to_string(relation))) {
      published.relation = relation;
      published.quantity = model::read_quantity(*number, {published.unit, Sign::any, false, {}});
      ++given;
    }
  }
  if (given != 1) {
    node.refuse(std::to_string(given) + " of value, at_most and at_least", "one of them");
  }
  published.tolerance =
      model::read_quantity(node.at("tolerance"), {published.unit, Sign::not_negative, false, {}});
  if (const auto over = node.find("over")) {
    if (over->text() != "starts" && over->text() != "run") {
      over->refuse("starts or run");
    }
    published.over_starts = over->text() == "starts";
  }
  if (const auto controller = node.find("controller")) {
    published.controller = resolved(*controller);
    published.over_starts = true;
  }
  return published;
}

PublishedCurve read_curve(const YamlNode& node, const run::LoadedScenario& loaded) {
  node.allow_keys({"name", "channel", "file", "source", "tolerance"});
  PublishedCurve curve;
  curve.name = node.at("name").text();
  curve.channel = node.at("channel").text();
  curve.source = node.at("source").text();
  const Channels channels(loaded, {curve.channel}, node.at("channel").place());
  const YamlNode file = node.at("file");
  curve.file = resolved(file);
  const Table table = read_table(curve.file);
  const Column* share = table.find("share");
  const Column* value = table.find("value");
  if (share == nullptr || value == nullptr || share->values.size() < 2) {
    file.refuse(model::quote(file.text()),
                "a file with the columns share [1] and value [unit], two rows or more");
  }
  curve.unit = value->unit;
  if (!units_agree(curve.unit, channels.unit(0))) {
    file.refuse("values in " + curve.unit, "a unit like " + channels.unit(0));
  }
  curve.share = share->values;
  curve.value = value->values * to_si_factor(curve.unit);
  if (curve.share.minCoeff() < 0.0 || curve.share.maxCoeff() > 1.0) {
    file.refuse("shares outside 0 to 1", "shares of the cycle");
  }
  curve.tolerance =
      model::read_quantity(node.at("tolerance"), {channels.unit(0), Sign::not_negative, false, {}});
  return curve;
}

PublishedGait read_gait_of(const std::string& name, const YamlNode& node, const PublishedOptions& options) {
  node.allow_keys({"scenario", "quantities", "curves"});
  PublishedGait published;
  published.name = name;
  published.where = node.place();
  const YamlNode scenario = node.at("scenario");
  published.loaded =
      run::read_scenario(options.scenario.empty() ? resolved(scenario) : options.scenario, options.files);
  const auto gait = read_gait(published.loaded);
  if (!gait) {
    scenario.refuse(model::quote(scenario.text()) + ", without a section gait",
                    "a scenario that says what its cycles are");
  }
  published.gait = *gait;
  published.section = read_section(published.loaded);
  if (const auto quantities = node.find("quantities")) {
    for (const YamlNode& one : quantities->items()) {
      published.quantities.push_back(read_one(one, published.loaded, published.section));
    }
  }
  if (const auto curves = node.find("curves")) {
    for (const YamlNode& one : curves->items()) {
      published.curves.push_back(read_curve(one, published.loaded));
    }
  }
  if (published.quantities.empty() && published.curves.empty()) {
    node.refuse("a gait without quantities or curves", "at least one");
  }
  return published;
}

/// Distance from the value, or beyond the limit (0 on its right side), signed.
double distance(const PublishedQuantity& published, double measured) {
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

double PublishedQuantity::outside(double measured) const {
  const double off = distance(*this, measured);
  return std::copysign(std::max(0.0, std::abs(off) - tolerance.value), off);
}

double PublishedQuantity::deviation(double measured) const {
  return distance(*this, measured) / tolerance.value;
}

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

PublishedRobot read_published(const std::string& path, const PublishedOptions& options) {
  const YamlNode root = YamlNode::load(path);
  check_format(root, "published/2");
  root.allow_keys({"plumbline", "title", "gaits"});
  PublishedRobot robot;
  robot.file = path;
  robot.title = root.at("title").text();
  const YamlNode gaits = root.at("gaits");
  std::vector<std::string> known;
  for (const auto& [name, node] : gaits.entries()) {
    known.push_back(name);
    if (options.gait.empty() || options.gait == name) {
      robot.gaits.push_back(read_gait_of(name, node, options));
    }
  }
  if (robot.gaits.empty()) {
    gaits.refuse(options.gait.empty() ? "no gait" : model::quote(options.gait),
                 "a gait" + nearest_names(options.gait, known));
  }
  return robot;
}

}  // namespace plumbline::validation
