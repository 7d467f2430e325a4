#include "validation/identify/trial/trial_controllers.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "simulator/model/kinds.h"
#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/trace/units.h"
#include "validation/identify/trial/physical_number.h"
#include "validation/identify/trial/trial_columns.h"

namespace plumbline::validation {

using model::Model;
using model::quote;
using model::YamlNode;

namespace {

double positive_or_refuse(const YamlNode& node, double value) {
  if (value <= 0.0) {
    node.refuse("a value that is not positive", "a value above zero; leave the key out for none");
  }
  return value;
}

std::optional<int> velocity_difference(const YamlNode& node) {
  const auto over = node.find("velocity_over");
  if (!over) {
    return std::nullopt;
  }
  const double samples = over->number();
  if (samples != 1.0 && samples != 2.0) {
    over->refuse("1 or 2 (samples over which the controller differences its measurement)");
  }
  return static_cast<int>(samples);
}

/// What all kinds have: motor, sensor, limit, and over how many samples the velocity is differenced.
void read_controller_frame(const YamlNode& node, const Model& model, Controller& c) {
  c.kind = node.at("kind").text();
  c.motor = node.at("motor").text();
  c.sensor = node.at("sensor").text();
  const std::string command_unit = known_motor(node.at("motor"), c.motor, model).command_unit;
  check_sensor(node.at("sensor"), c.sensor, model);
  if (!model.find_sensor(c.sensor)->shows_position()) {
    node.at("sensor").refuse("a sensor that shows no position",
                             "the sensor that the controller closes its loop on");
  }
  if (const auto limit = node.find("command_limit")) {
    c.command_limit =
        positive_or_refuse(*limit, read_physical(*limit, command_unit, "the command of motor " + c.motor));
  }
  if (const auto over = velocity_difference(node)) {
    c.velocity_over = *over;
  }
}

/// command = position_gain (reference - measured) + velocity_gain (d(reference)/dt - d(measured)/dt) + added.
Controller read_pd(const YamlNode& node, const Model& model) {
  Controller c;
  read_controller_frame(node, model, c);
  const std::string command = known_motor(node.at("motor"), c.motor, model).command_unit;
  const std::string position = model::reading_unit(model, c.sensor);
  c.position_gain =
      model::read_quantity(node.at("position_gain"), {command + "/" + position, {}, false, {}}).value;
  if (const auto gain = node.find("velocity_gain")) {
    c.velocity_gain = model::read_quantity(*gain, {command + " s/" + position, {}, false, {}}).value;
  }
  return c;
}

ControllerUse read_controller(const YamlNode& node, const Model& model) {
  std::vector<std::string> keys{"kind",        "motor",         "sensor",
                                "reference",   "position_gain", "velocity_gain",
                                "disturbance", "command_limit", "velocity_over"};
  const bool is_pd = node.at("kind").text() == "pd";
  if (is_pd) {
    keys.insert(keys.end(), {"velocity", "reference_velocity"});
  }
  node.allow_keys(keys);
  ControllerUse use;
  use.place = node.place();
  use.controller = is_pd ? read_pd(node, model) : read_controller_law(node, model);
  const Controller& c = use.controller;
  const std::string position = model::reading_unit(model, c.sensor);
  use.reference = read_column(node.at("reference"), position, "sensor " + c.sensor, {"unwrap"});
  read_wrap(node.at("reference"), position, "sensor " + c.sensor, use.reference);
  if (const auto velocity = node.find("velocity")) {
    use.velocity = read_column(*velocity, position + "/s", "the rate of sensor " + c.sensor);
  }
  if (const auto velocity = node.find("reference_velocity")) {
    use.reference_velocity = read_column(*velocity, position + "/s", "the rate of sensor " + c.sensor);
  }
  if (const auto disturbance = node.find("disturbance")) {
    use.disturbance = read_column(*disturbance, known_motor(node.at("motor"), c.motor, model).command_unit,
                                  "the command of motor " + c.motor);
  }
  return use;
}

}  // namespace

const model::Motor& known_motor(const YamlNode& node, const std::string& name, const Model& model) {
  const model::Motor* motor = model.find_motor(name);
  if (motor == nullptr) {
    node.refuse("motor " + quote(name), "a motor of the model" + nearest_names(name, names_of(model.motors)));
  }
  return *motor;
}

Controller read_controller_law(const YamlNode& node, const Model& model) {
  Controller c;
  const std::string kind = node.at("kind").text();
  if (kind != "cascade_pd") {
    node.at("kind").refuse("the kind cascade_pd" + nearest_names(kind, {"cascade_pd", "pd"}));
  }
  read_controller_frame(node, model, c);
  const std::string command_unit = known_motor(node.at("motor"), c.motor, model).command_unit;
  const std::string position = model::reading_unit(model, c.sensor);
  c.position_gain = model::read_quantity(node.at("position_gain"), {"1/s", {}, false, {}}).value;
  c.velocity_gain =
      model::read_quantity(node.at("velocity_gain"), {command_unit + " s/" + position, {}, false, {}}).value;
  return c;
}

std::vector<ControllerUse> read_controllers(const YamlNode& node, const Model& model) {
  std::vector<ControllerUse> uses;
  std::set<std::string> motors;
  for (const YamlNode& item : node.items()) {
    uses.push_back(read_controller(item, model));
    if (!motors.insert(uses.back().controller.motor).second) {
      item.refuse("a second controller of motor " + uses.back().controller.motor, "one for each motor");
    }
  }
  return uses;
}

/// A pd computes the command of a motor that has none recorded, from what is measured.
void check_controllers(const TrialFile& file) {
  for (const ControllerUse& use : file.controllers) {
    const Controller& c = use.controller;
    const bool recorded = std::any_of(file.commands.begin(), file.commands.end(),
                                      [&](const CommandUse& command) { return command.motor == c.motor; });
    const bool measured = std::any_of(file.measured.begin(), file.measured.end(),
                                      [&](const MeasuredUse& one) { return one.sensor == c.sensor; });
    if (!recorded && !measured) {
      throw InputError(use.place, "sensor " + quote(c.sensor) + " not among `measured`",
                       "it there: the command of " + c.motor + " is computed from it");
    }
    if (recorded && c.kind == "pd") {
      throw InputError(use.place, "a pd at motor " + c.motor + ", whose command is recorded, too",
                       "one of them: a pd stands for a command that was not recorded");
    }
  }
}

}  // namespace plumbline::validation
