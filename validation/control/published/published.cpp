#include "validation/control/published/published.h"

#include <array>
#include <cmath>

#include "simulator/model/plain_number.h"
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

int read_foot(const YamlNode& node, const run::LoadedScenario& loaded, const Gait& gait) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < gait.feet.size(); ++i) {
    known.push_back(loaded.model.feet[static_cast<std::size_t>(gait.feet[i])].name);
    if (known.back() == node.text()) {
      return static_cast<int>(i);
    }
  }
  node.refuse("a foot of the gait" + nearest_names(node.text(), known));
}

PublishedQuantity read_one(const YamlNode& node, const run::LoadedScenario& loaded, const Gait& gait,
                           const std::optional<PoincareSection>& section) {
  node.allow_keys(
      {"name", "measure", "value", "at_most", "at_least", "tolerance", "over", "controller", "begins_with"});
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
  if (const auto foot = node.find("begins_with")) {
    if (published.measure.of() != Measure::Of::cycle) {
      foot->refuse("a foot for " + published.measure.text, "begins_with for measures of a cycle only");
    }
    published.foot = read_foot(*foot, loaded, gait);
  }
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

/// Columns of a file as one: a name, or a sum of names times factors, all of one unit.
class CurveFile {
 public:
  explicit CurveFile(const YamlNode& node) : node_(node), table_(read_table(resolved(node))) {}

  const Table& table() const { return table_; }
  const Column* find(const std::string& name) const { return table_.find(name); }

  /// SI; the first column's unit.
  Eigen::VectorXd values(const YamlNode& column, std::string& unit) const {
    if (!column.is_map()) {
      return one(column, column.text(), unit);
    }
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(table_.rows());
    for (const auto& [name, factor] : column.entries()) {
      sum += factor.number() * one(factor, name, unit);
    }
    return sum;
  }
  Eigen::VectorXd one(const YamlNode& where, const std::string& name, std::string& unit) const {
    const Column* column = table_.find(name);
    if (column == nullptr) {
      std::vector<std::string> known;
      for (const Column& any : table_.columns) {
        known.push_back(any.name);
      }
      where.refuse(model::quote(name), "a column of " + node_.text() + nearest_names(name, known));
    }
    if (!unit.empty() && !units_agree(unit, column->unit)) {
      where.refuse(name + " in " + column->unit, "columns of one unit, " + unit);
    }
    unit = unit.empty() ? column->unit : unit;
    return column->values * to_si_factor(column->unit);
  }

 private:
  const YamlNode& node_;
  Table table_;
};

/// Rows from `from` to `to` of a record, and the first at 0.
void cut_cycle(const YamlNode& cycle, PublishedCurve& curve) {
  cycle.allow_keys({"from", "to"});
  const double from = model::read_number(cycle.at("from"), "s");
  const double to = model::read_number(cycle.at("to"), "s");
  constexpr double kRounding = 1e-9;  // s
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < curve.at.size(); ++k) {
    if (curve.at[k] >= from - kRounding && curve.at[k] <= to + kRounding) {
      kept.push_back(k);
    }
  }
  if (kept.size() < 2) {
    cycle.refuse("fewer than two rows between from and to", "a cycle of the file");
  }
  const auto cut = [&](Eigen::VectorXd& values) {
    Eigen::VectorXd some(static_cast<Eigen::Index>(kept.size()));
    for (std::size_t k = 0; k < kept.size(); ++k) {
      some[static_cast<Eigen::Index>(k)] = values[kept[k]];
    }
    values = some;
  };
  cut(curve.value);
  if (curve.spread.size() > 0) {
    cut(curve.spread);
  }
  cut(curve.at);
  curve.at.array() -= from;
}

PublishedCurve read_curve(const YamlNode& node, const run::LoadedScenario& loaded, const Gait& gait) {
  node.allow_keys(
      {"name", "channel", "begins_with", "file", "column", "spread", "cycle", "source", "tolerance"});
  PublishedCurve curve;
  curve.name = node.at("name").text();
  curve.channel = node.at("channel").text();
  curve.source = node.at("source").text();
  const Channels channels(loaded, {curve.channel}, node.at("channel").place());
  if (const auto foot = node.find("begins_with")) {
    curve.foot = read_foot(*foot, loaded, gait);
  }
  const YamlNode file = node.at("file");
  curve.file = resolved(file);
  const CurveFile columns(file);
  curve.over_shares = columns.find("share") != nullptr;
  if ((!curve.over_shares && columns.find("t") == nullptr) || columns.table().rows() < 2) {
    file.refuse(model::quote(file.text()), "a file with a column t [s] or share [1], two rows or more");
  }
  std::string unit_at;
  curve.at = columns.one(file, curve.over_shares ? "share" : "t", unit_at);
  if (!units_agree(unit_at, curve.over_shares ? "1" : "s")) {
    file.refuse("a column " + std::string(curve.over_shares ? "share" : "t") + " in " + unit_at,
                "t [s], share [1]");
  }
  const auto column = node.find("column");
  curve.value = column ? columns.values(*column, curve.unit) : columns.one(file, "value", curve.unit);
  if (!units_agree(curve.unit, channels.unit(0))) {
    file.refuse("values in " + curve.unit, "a unit like " + channels.unit(0));
  }
  if (const auto spread = node.find("spread")) {
    std::string unit = curve.unit;
    curve.spread = columns.values(*spread, unit);
  }
  if (const auto cycle = node.find("cycle")) {
    if (curve.over_shares) {
      cycle->refuse("a cycle of a file over shares", "one over time");
    }
    cut_cycle(*cycle, curve);
  }
  if (curve.at.minCoeff() < 0.0 || (curve.over_shares && curve.at.maxCoeff() > 1.0)) {
    file.refuse("times before the cycle, or shares outside 0 to 1",
                "times from 0 s on, or shares of the cycle");
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
      published.quantities.push_back(read_one(one, published.loaded, *gait, published.section));
    }
  }
  if (const auto curves = node.find("curves")) {
    for (const YamlNode& one : curves->items()) {
      published.curves.push_back(read_curve(one, published.loaded, *gait));
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
