#include "validation/identify/trial/trial_file.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "simulator/model/effect_list.h"
#include "simulator/model/kinds.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/quantity.h"
#include "simulator/model/terrain_file.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/trace/units.h"
#include "validation/identify/trial/physical_number.h"
#include "validation/identify/trial/trial_columns.h"
#include "validation/identify/trial/trial_controllers.h"
#include "validation/identify/trial/trial_points.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;
using model::Model;
using model::quote;
using model::YamlNode;

std::vector<std::string> sensor_and_switch_names(const Model& model) {
  std::vector<std::string> names = names_of(model.sensors);
  const std::vector<std::string> switches = names_of(model.switches);
  names.insert(names.end(), switches.begin(), switches.end());
  return names;
}

void check_measured(const YamlNode& node, const std::string& name, const Model& model) {
  if (model.find_sensor(name) == nullptr) {
    node.refuse("sensor " + quote(name),
                "a sensor of the model" + nearest_names(name, sensor_and_switch_names(model)));
  }
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

/// One section or a list of them, in the order of time.
std::vector<Section> read_sections(const YamlNode& node) {
  if (node.is_map()) {
    return {read_section(node)};
  }
  std::vector<Section> sections;
  for (const YamlNode& item : node.items()) {
    sections.push_back(read_section(item));
    if (sections.size() > 1 && sections.back().from < sections[sections.size() - 2].to) {
      item.refuse("a section that begins before the one before it ends", "sections in the order of time");
    }
  }
  if (sections.empty()) {
    node.refuse("no sections", "{from: ..., to: ...}, or a list of these");
  }
  return sections;
}

/// A column of its own, or the column of a force and the force above which the switch counts as closed.
MeasuredUse read_switch(const YamlNode& node, const std::string& name) {
  const auto above = node.is_map() ? node.find("above") : std::nullopt;
  if (!above) {
    return {name, read_column(node, "1", "contact switch " + name)};
  }
  MeasuredUse use{name, read_column(node, "N", "the force at contact switch " + name, {"above"})};
  use.above = read_physical(*above, "N", "the force at contact switch " + name);
  return use;
}

MeasuredUse read_sensor(const YamlNode& node, const std::string& name, const Model& model) {
  check_measured(node, name, model);
  const std::string unit = model::reading_unit(model, name);
  const std::string& whole = model.find_sensor(name)->group;
  if (model.find_sensor(name)->reading == model::PointReading::orientation) {
    node.refuse("a component of an orientation", "all of it: " + whole + ": {columns: [w, x, y, z]}");
  }
  const bool plate = model.find_sensor(name)->is_force_plate();
  const std::string owner = (plate ? "force plate " : "sensor ") + name;
  std::vector<std::string> keys{"resolution", "noise", "offset_uncertainty", "unwrap"};
  if (plate) {
    keys.emplace_back("zero");
  }
  MeasuredUse use{name, read_column(node, unit, owner, keys)};
  if (const auto zero = node.find("zero")) {
    use.zero = read_section(*zero);
  }
  read_wrap(node, unit, owner, use.column);
  use.resolution = read_not_negative(node, "resolution", unit, owner);
  use.noise = read_not_negative(node, "noise", unit, owner);
  use.offset_uncertainty = read_not_negative(node, "offset_uncertainty", unit, owner).value_or(0.0);
  const model::Sensor& sensor = *model.find_sensor(name);
  const bool stated = use.resolution || use.noise;
  if (stated && use.resolution.value_or(sensor.resolution) == 0.0 &&
      use.noise.value_or(sensor.noise) == 0.0) {
    node.refuse("neither resolution nor noise above zero",
                "one of them: together they are the channel's floor");
  }
  return use;
}

std::vector<MeasuredUse> read_measured(const YamlNode& node, const Model& model) {
  std::vector<MeasuredUse> uses;
  bool any_sensor = false;
  for (const auto& [name, entry] : at_least_one(node, "sensor")) {
    if (const model::Sensor* point = point_sensor(model, name)) {
      read_point(entry, *point, model, uses);
      any_sensor = true;
      continue;
    }
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

double positive_time(const YamlNode& node) {
  const double value = read_physical(node, "s", "a time");
  if (!(value > 0.0)) {
    node.refuse("a time that is not above zero", "a longer one");
  }
  return value;
}

void read_sampling(const YamlNode& node, LogSampling& sampling) {
  sampling.place = node.place();
  if (const auto resample = node.find("resample")) {
    sampling.place = resample->place();
    if (resample->is_map()) {
      sampling.period = positive_time(*resample);
    } else if (resample->text() == "even") {
      sampling.even = true;
    } else {
      resample->refuse("a period {value: 5, unit: ms}, or `even` where only the stamps jitter");
    }
  }
  if (const auto gap = node.find("longest_gap")) {
    sampling.longest_gap = positive_time(*gap);
  }
}

void read_time(const YamlNode& node, TrialFile& file) {
  const auto rate = node.is_map() ? node.find("rate") : std::nullopt;
  if (!rate) {
    file.time = read_column(node, "s", "the time", {"resample", "longest_gap"});
    read_sampling(node, file.sampling);
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
    const std::string owner = "the command of motor " + motor;
    CommandUse use{motor, read_column(entry, unit, owner, {"before"})};
    if (const auto before = entry.find("before")) {
      use.before = read_physical(*before, unit, owner);
    }
    uses.push_back(std::move(use));
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

/// Effects that the robot had in this trial alone. Their states and released ratios would make another state
/// of the robot's.
std::vector<model::EffectUse> read_configuration(const YamlNode& node, const Model& model) {
  node.allow_keys({"effects"});
  Model changed = model;
  changed.effects.clear();
  const std::vector<YamlNode> items = node.at("effects").items();
  model::read_effects(node.at("effects"), model::known_effects(), changed);
  for (std::size_t i = 0; i < changed.effects.size(); ++i) {
    const model::EffectUse& use = changed.effects[i];
    if (use.law->state_count() > 0 || model.resolve(*use.law, use.at) == effects::Place::ratio) {
      items[i].refuse(use.label() + ", which adds a state",
                      "a payload, a spring or another effect without states");
    }
  }
  return changed.effects;
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

/// Columns that name no topic are the file's, unless they are written whole: /joint_states.position.elbow.
void read_topic(const YamlNode& root, TrialFile& file) {
  if (const auto topic = root.find("topic")) {
    file.topic = topic->text();
    file.topic_place = topic->place();
    if (file.topic.empty()) {
      topic->refuse("no name", "a topic of the bag, such as /joint_states");
    }
  }
  for_each_column(file, [&](ColumnUse& use) {
    if (use.has_topic && !file.topic_place) {
      file.topic_place = use.place;
    }
    const bool is_whole = use.has_topic || use.name.empty() || use.name.front() == '/';
    if (!is_whole && !file.topic.empty()) {
      use.name = file.topic + "." + use.name;
    }
  });
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
    for (const ColumnUse& column : use.quaternion) {
      refuse_second_use(column, taken);
    }
    if (!use.above && use.quaternion.empty()) {  // a switch may be read off a force that is measured, too
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

void for_each_column(TrialFile& file, const std::function<void(ColumnUse&)>& visit) {
  const auto optional = [&](std::optional<ColumnUse>& use) {
    if (use) {
      visit(*use);
    }
  };
  visit(file.time);
  for (MeasuredUse& use : file.measured) {
    std::for_each(use.quaternion.begin(), use.quaternion.end(), visit);
    if (use.quaternion.empty()) {
      visit(use.column);
    }
  }
  for (CommandUse& use : file.commands) {
    visit(use.column);
  }
  for (ControllerUse& use : file.controllers) {
    visit(use.reference);
    optional(use.disturbance);
    optional(use.velocity);
    optional(use.reference_velocity);
  }
}

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

TrialFile read_trial_file(const std::string& path, const Model& model) {
  TrialFile file;
  file.path = trial_yaml(path);
  file.folder = fs::path(file.path).parent_path().string();
  const YamlNode root = YamlNode::load(file.path);
  check_format(root, "trial/1");
  root.allow_keys({"plumbline",     "title",
                   "model",         "role",
                   "data",          "data_folder_env",
                   "columns",       "topic",
                   "section",       "leave_out",
                   "missing",       "rows",
                   "time",          "clock_shift_uncertainty",
                   "commands",      "measured",
                   "locked",        "terrain",
                   "configuration", "start",
                   "controllers",   "events"});
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
    file.sections = read_sections(*section);
  }
  if (const auto left_out = root.find("leave_out")) {
    file.left_out = read_sections(*left_out);
  }
  if (const auto missing = root.find("missing")) {
    file.fill_missing = missing->text() == "fill";
    if (!file.fill_missing && missing->text() != "refuse") {
      missing->refuse("refuse (the default) or fill" + nearest_names(missing->text(), {"refuse", "fill"}));
    }
  }
  if (const auto rows = root.find("rows")) {
    rows->allow_keys({"bad"});
    const YamlNode bad = rows->at("bad");
    file.leave_out_bad_rows = bad.text() == "leave_out";
    if (!file.leave_out_bad_rows && bad.text() != "refuse") {
      bad.refuse("refuse (the default) or leave_out" + nearest_names(bad.text(), {"refuse", "leave_out"}));
    }
  }
  if (const auto shift = root.find("clock_shift_uncertainty")) {
    file.clock_shift_uncertainty = positive_time(*shift);
  }
  file.measured = read_measured(root.at("measured"), model);
  if (root.has("commands") || (!model.motors.empty() && !root.has("controllers"))) {
    file.commands = read_commands(root.at("commands"), model);
  }
  if (const auto start = root.find("start")) {
    file.start = read_start(*start, model);
  }
  if (const auto locked = root.find("locked")) {
    file.locks = read_locks(*locked, model);
  }
  if (const auto terrain = root.find("terrain")) {
    file.terrain = model::read_terrain(*terrain);
  }
  if (const auto configuration = root.find("configuration")) {
    file.configuration = read_configuration(*configuration, model);
  }
  if (const auto controllers = root.find("controllers")) {
    file.controllers = read_controllers(*controllers, model);
  }
  if (const auto events = root.find("events")) {
    file.events = read_events(*events);
  }
  read_topic(root, file);
  check_columns_differ(file);
  check_controllers(file);
  return file;
}

}  // namespace plumbline::validation
