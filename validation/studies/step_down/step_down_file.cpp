#include "simulator/model/plain_number.h"
#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"
#include "validation/studies/step_down/step_down.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;
using Sign = model::QuantityRule::Sign;

double quantity(const YamlNode& node, const char* unit, Sign sign = Sign::positive) {
  return model::read_quantity(node, {unit, sign, false, {}}).value;
}

PublishedStepDown read_published_one(const YamlNode& node) {
  node.allow_keys({"height", "outcome", "first", "second", "source"});
  PublishedStepDown one;
  one.height = model::read_positive(node.at("height"), "m");
  const YamlNode outcome = node.at("outcome");
  if (outcome.text() != "passed" && outcome.text() != "broke") {
    outcome.refuse("passed or broke");
  }
  one.passed = outcome.text() == "passed";
  if (const auto first = node.find("first")) {
    one.first = model::read_positive(*first, "N s");
  }
  if (const auto second = node.find("second")) {
    one.second = model::read_positive(*second, "N s");
  }
  one.source = node.at("source").text();
  return one;
}

void read_published_part(const YamlNode& node, StepDownTest& test) {
  node.allow_keys({"flat", "flat_deviation", "heights"});
  test.flat = quantity(node.at("flat"), "N s");
  test.flat_deviation = quantity(node.at("flat_deviation"), "N s");
  for (const YamlNode& one : node.at("heights").items()) {
    test.published.push_back(read_published_one(one));
  }
}

}  // namespace

StepDownTest read_step_down(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  model::check_format(root, "step_down/1");
  root.allow_keys({"plumbline", "title", "scenario", "impact", "edge", "steps", "fuse", "force_time",
                   "heights", "controllers", "published"});
  const YamlNode scenario = root.at("scenario");
  StepDownTest test{path,
                    root.at("title").text(),
                    run::read_scenario(model::beside(path, scenario.text())),
                    {},
                    read_rigid_gait(model::beside(path, root.at("impact").text())),
                    0.0,
                    12,
                    0.0,
                    0.0,
                    {},
                    {},
                    {},
                    0.0,
                    0.0};
  const auto gait = read_gait(test.scenario);
  if (!gait || gait->cycle != Gait::Cycle::step) {
    scenario.refuse(model::quote(scenario.text()) + ", whose gait has no steps",
                    "a scenario with a section gait whose cycle is step");
  }
  test.gait = *gait;
  test.edge = quantity(root.at("edge"), "m");
  const double steps = root.at("steps").number();
  if (!(steps >= 2.0 && steps <= 1000.0)) {
    root.at("steps").refuse("2 to 1000 steps");
  }
  test.enough = static_cast<long>(steps);
  test.fuse = quantity(root.at("fuse"), "N s");
  test.force_time = quantity(root.at("force_time"), "s");
  for (const YamlNode& height : root.at("heights").items()) {
    test.heights.push_back(model::read_number(height, "m"));
  }
  for (const YamlNode& one : root.at("controllers").items()) {
    one.allow_keys({"name", "controller"});
    test.controllers.push_back(
        {one.at("name").text(), run::read_controller(model::beside(path, one.at("controller").text()))});
  }
  if (test.heights.empty() || test.controllers.empty()) {
    root.at(test.heights.empty() ? "heights" : "controllers").refuse("an empty list", "one or more");
  }
  if (const auto published = root.find("published")) {
    read_published_part(*published, test);
  }
  return test;
}

}  // namespace plumbline::validation
