#include "validation/trial/trial_file.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "simulator/model/kinds.h"
#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "validation/trial/physical_number.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;
using model::Model;
using model::quote;
using model::YamlNode;

template <typename Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const Item& item : items) {
    names.push_back(item.name);
  }
  return names;
}

std::vector<std::string> sensor_and_switch_names(const Model& model) {
  std::vector<std::string> names = names_of(model.sensors);
  const std::vector<std::string> switches = names_of(model.switches);
  names.insert(names.end(), switches.begin(), switches.end());
  return names;
}

void check_sensor(const YamlNode& node, const std::string& name, const Model& model) {
  if (model.find_sensor(name) == nullptr) {
    node.refuse("sensor " + quote(name),
                "a sensor of the model" + nearest_names(name, names_of(model.sensors)));
  }
}

void check_measured(const YamlNode& node, const std::string& name, const Model& model) {
  if (model.find_sensor(name) == nullptr) {
    node.refuse("sensor " + quote(name),
                "a sensor of the model" + nearest_names(name, sensor_and_switch_names(model)));
  }
}

ColumnUse read_column(const YamlNode& node, const std::string& expected_unit, const std::string& owner,
                      const std::string& further_key = "") {
  if (!node.is_map()) {
    node.refuse("a map {column: ..., unit: " + expected_unit + "}");
  }
  node.allow_keys(further_key.empty() ? std::vector<std::string>{"column", "unit"}
                                      : std::vector<std::string>{"column", "unit", further_key});
  ColumnUse use;
  use.name = node.at("column").text();
  use.place = node.at("column").place();
  use.expected_unit = expected_unit;
  use.owner = owner;
  if (const auto unit = node.find("unit")) {
    use.unit = unit->text();
    unit_factor(use.unit, expected_unit, owner, unit->place());  // refuses a wrong one here
  }
  return use;
}

std::vector<std::pair<std::string, YamlNode>> at_least_one(const YamlNode& node, const std::string& what) {
  auto entries = node.entries();
  if (entries.empty()) {
    node.refuse("an empty map", "at least one " + what);
  }
  return entries;
}

Section read_section(const YamlNode& node) {
  node.allow_keys({"from", "to"});
  Section section{read_physical(node.at("from"), "s", "a time"), read_physical(node.at("to"), "s", "a time"),
                  node.place()};
  if (!(section.to > section.from)) {
    node.at("to").refuse("a time that is not after `from`", "a later one");
  }
  return section;
}

/// A column of its own, or the column of a force and the force above which the switch counts as closed.
MeasuredUse read_switch(const YamlNode& node, const std::string& name) {
  const auto above = node.is_map() ? node.find("above") : std::nullopt;
  if (!above) {
    return {name, read_column(node, "1", "contact switch " + name)};
  }
  MeasuredUse use{name, read_column(node, "N", "the force at contact switch " + name, "above")};
  use.above = read_physical(*above, "N", "the force at contact switch " + name);
  return use;
}

MeasuredUse read_sensor(const YamlNode& node, const std::string& name, const Model& model) {
  check_measured(node, name, model);
  const std::string unit = model::reading_unit(model, name);
  if (!model.find_sensor(name)->is_force_plate()) {
    return {name, read_column(node, unit, "sensor " + name)};
  }
  MeasuredUse use{name, read_column(node, unit, "force plate " + name, "zero")};
  if (const auto zero = node.find("zero")) {
    use.zero = read_section(*zero);
  }
  return use;
}

std::vector<MeasuredUse> read_measured(const YamlNode& node, const Model& model) {
  std::vector<MeasuredUse> uses;
  bool any_sensor = false;
  for (const auto& [name, entry] : at_least_one(node, "sensor")) {
    const bool is_switch = model.find_switch(name) != nullptr;
    uses.push_back(is_switch ? read_switch(entry, name) : read_sensor(entry, name, model));
    any_sensor = any_sensor || !is_switch;
  }
  if (!any_sensor) {
    node.refuse("contact switches only", "at least one sensor of a position or force");
  }
  return uses;
}

std::vector<std::string> read_columns(const YamlNode& node) {
  std::vector<std::string> names;
  for (const YamlNode& item : node.items()) {
    if (std::find(names.begin(), names.end(), item.text()) != names.end()) {
      item.refuse(quote(item.text()) + " twice", "each column name once");
    }
    names.push_back(item.text());
  }
  if (names.empty()) {
    node.refuse("no names", "the names of the data file's columns, in its order");
  }
  return names;
}

void read_time(const YamlNode& node, TrialFile& file) {
  const auto rate = node.is_map() ? node.find("rate") : std::nullopt;
  if (!rate) {
    file.time = read_column(node, "s", "the time");
    return;
  }
  node.allow_keys({"rate"});
  file.rate = read_physical(*rate, "Hz", "a sample rate");
  if (!(file.rate > 0.0)) {
    rate->refuse("a rate that is not above zero", "samples for each second");
  }
}

std::vector<Start> read_start(const YamlNode& node, const Model& model) {
  std::vector<Start> starts;
  for (const auto& [name, entry] : node.entries()) {
    const model::Coordinate* coordinate = model.find_coordinate(name);
    if (coordinate == nullptr) {
      entry.refuse(quote(name),
                   "a coordinate of the model" + nearest_names(name, names_of(model.coordinates)));
    }
    const model::Quantity value =
        model::read_quantity(entry, {position_unit(coordinate->angular), {}, false, {}});
    if (!(value.uncertainty > 0.0)) {
      entry.refuse("no uncertainty", "how well the start is known, such as `uncertainty: 0.005`");
    }
    starts.push_back({name, value.value, value.uncertainty});
  }
  return starts;
}

std::vector<CommandUse> read_commands(const YamlNode& node, const Model& model) {
  std::vector<CommandUse> uses;
  for (const auto& [motor, entry] : at_least_one(node, "motor")) {
    const std::string unit = known_motor(entry, motor, model).command_unit;
    uses.push_back({motor, read_column(entry, unit, "the command of motor " + motor)});
  }
  return uses;
}

std::vector<Lock> read_locks(const YamlNode& node, const Model& model) {
  std::vector<Lock> locks;
  for (const auto& [at, entry] : node.entries()) {
    const std::string unit = placed_unit(entry, at, model);
    locks.push_back({at, read_physical(entry, unit, at)});
  }
  return locks;
}

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

ControllerUse read_controller(const YamlNode& node, const Model& model) {
  node.allow_keys({"kind", "motor", "sensor", "reference", "position_gain", "velocity_gain", "disturbance",
                   "command_limit", "velocity_over"});
  ControllerUse use;
  use.controller = read_controller_law(node, model);
  const Controller& c = use.controller;
  use.reference =
      read_column(node.at("reference"), model::reading_unit(model, c.sensor), "sensor " + c.sensor);
  if (const auto disturbance = node.find("disturbance")) {
    use.disturbance = read_column(*disturbance, known_motor(node.at("motor"), c.motor, model).command_unit,
                                  "the command of motor " + c.motor);
  }
  return use;
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

std::vector<double> read_events(const YamlNode& node) {
  std::vector<double> events;
  for (const YamlNode& item : node.items()) {
    events.push_back(read_physical_text(item, "s", "a time"));
    if (events.size() > 1 && events[events.size() - 2] >= events.back()) {
      item.refuse("times that rise");
    }
  }
  return events;
}

void refuse_second_use(const ColumnUse& use, std::set<std::string>& taken) {
  if (!taken.insert(use.name).second) {
    throw InputError(use.place, "column " + quote(use.name) + " a second time", "each column used once");
  }
}

/// One column cannot be two signals; only controllers may share a reference or a disturbance.
void check_columns_differ(const TrialFile& file) {
  std::set<std::string> taken{file.time.name};
  for (const MeasuredUse& use : file.measured) {
    if (!use.above) {  // a switch may be read off a force that is measured, too
      refuse_second_use(use.column, taken);
    }
  }
  for (const CommandUse& use : file.commands) {
    refuse_second_use(use.column, taken);
  }
  for (const ControllerUse& use : file.controllers) {
    std::set<std::string> own = taken;
    refuse_second_use(use.reference, own);
    if (use.disturbance) {
      refuse_second_use(*use.disturbance, own);
    }
  }
}

}  // namespace

Role read_role(const YamlNode& node) {
  const std::string text = node.text();
  if (text == "train") {
    return Role::train;
  }
  if (text == "held-out") {
    return Role::held_out;
  }
  if (text != "test") {
    node.refuse("train, held-out or test" + nearest_names(text, {"train", "held-out", "test"}));
  }
  return Role::test;
}

std::string to_string(Role role) {
  return role == Role::train ? "train" : role == Role::held_out ? "held-out" : "test";
}

std::string trial_yaml(const std::string& path) {
  std::error_code none;
  return fs::is_directory(path, none) ? (fs::path(path) / "trial.yaml").string() : path;
}

std::string read_model_path(const YamlNode& root) {
  return model::beside(root.file(), root.at("model").text());
}

std::string placed_unit(const YamlNode& node, const std::string& name, const Model& model) {
  if (const model::Coordinate* coordinate = model.find_coordinate(name)) {
    return position_unit(coordinate->angular);
  }
  if (const model::Motor* motor = model.find_motor(name)) {
    return position_unit(motor->angular);
  }
  if (model.find_pulley(name) != nullptr) {
    return position_unit(true);
  }
  std::vector<std::string> known = names_of(model.coordinates);
  const std::vector<std::string> motors = names_of(model.motors);
  known.insert(known.end(), motors.begin(), motors.end());
  const std::vector<std::string> pulleys = names_of(model.pulleys);
  known.insert(known.end(), pulleys.begin(), pulleys.end());
  node.refuse(quote(name), "a coordinate, motor or pulley of the model" + nearest_names(name, known));
}

const model::Motor& known_motor(const YamlNode& node, const std::string& name, const Model& model) {
  const model::Motor* motor = model.find_motor(name);
  if (motor == nullptr) {
    node.refuse("motor " + quote(name), "a motor of the model" + nearest_names(name, names_of(model.motors)));
  }
  return *motor;
}

Controller read_controller_law(const YamlNode& node, const Model& model) {
  Controller c;
  c.kind = node.at("kind").text();
  if (c.kind != "cascade_pd") {
    node.at("kind").refuse("the kind cascade_pd" + nearest_names(c.kind, {"cascade_pd"}));
  }
  c.motor = node.at("motor").text();
  c.sensor = node.at("sensor").text();
  const std::string command_unit = known_motor(node.at("motor"), c.motor, model).command_unit;
  check_sensor(node.at("sensor"), c.sensor, model);
  const std::string position = model::reading_unit(model, c.sensor);
  c.position_gain = model::read_quantity(node.at("position_gain"), {"1/s", {}, false, {}}).value;
  c.velocity_gain =
      model::read_quantity(node.at("velocity_gain"), {command_unit + " s/" + position, {}, false, {}}).value;
  if (const auto limit = node.find("command_limit")) {
    c.command_limit =
        positive_or_refuse(*limit, read_physical(*limit, command_unit, "the command of motor " + c.motor));
  }
  if (const auto over = velocity_difference(node)) {
    c.velocity_over = *over;
  }
  return c;
}

TrialFile read_trial_file(const std::string& path, const Model& model) {
  TrialFile file;
  file.path = trial_yaml(path);
  file.folder = fs::path(file.path).parent_path().string();
  const YamlNode root = YamlNode::load(file.path);
  check_format(root, "trial/1");
  root.allow_keys({"plumbline", "title", "model", "role", "data", "data_folder_env", "columns", "section",
                   "time", "commands", "measured", "locked", "start", "controllers", "events"});
  file.title = root.at("title").text();
  file.model_file = read_model_path(root);
  file.role = read_role(root.at("role"));
  file.data = root.at("data").text();
  if (const auto variable = root.find("data_folder_env")) {
    file.data_folder_env = variable->text();
    file.data_folder_env_place = variable->place();
  }
  if (const auto columns = root.find("columns")) {
    file.columns = read_columns(*columns);
  }
  read_time(root.at("time"), file);
  if (const auto section = root.find("section")) {
    file.section = read_section(*section);
  }
  file.measured = read_measured(root.at("measured"), model);
  if (!model.motors.empty() || root.has("commands")) {
    file.commands = read_commands(root.at("commands"), model);
  }
  if (const auto start = root.find("start")) {
    file.start = read_start(*start, model);
  }
  if (const auto locked = root.find("locked")) {
    file.locks = read_locks(*locked, model);
  }
  if (const auto controllers = root.find("controllers")) {
    file.controllers = read_controllers(*controllers, model);
  }
  if (const auto events = root.find("events")) {
    file.events = read_events(*events);
  }
  check_columns_differ(file);
  return file;
}

}  // namespace plumbline::validation
