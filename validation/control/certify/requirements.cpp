#include "validation/control/certify/requirements.h"

#include <algorithm>
#include <filesystem>

#include "simulator/model/kinds.h"
#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/trace/error.h"
#include "simulator/trace/units.h"
#include "validation/control/published/published.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;
using model::YamlNode;

std::string resolved(const YamlNode& node) {
  return fs::path(model::beside(node.file(), node.text())).lexically_normal().string();
}

/// A file of requirements and the files that it stands on: each key as the newest one states it.
class Chain {
 public:
  explicit Chain(const std::string& path) : files_(model::read_chain(path, "requirements/1")) {
    for (const YamlNode& file : files_) {
      file.allow_keys({"plumbline", "base", "note", "title", "scenario", "valid_until", "seed", "cycles",
                       "reference", "required", "drive"});
    }
  }
  /// The file that states the key; where none does, the named one, which then says that it is missing.
  const YamlNode& of(const std::string& key) const {
    for (const YamlNode& file : files_) {
      if (file.has(key)) return file;
    }
    return files_.front();
  }
  YamlNode at(const std::string& key) const { return of(key).at(key); }

 private:
  std::vector<YamlNode> files_;
};

double number(const YamlNode& node, const std::string& key, const std::string& unit) {
  model::QuantityRule rule;
  rule.unit = unit;
  return model::read_quantity(node.at(key), rule).value;
}

double ranged(const YamlNode& node, const std::string& key, const std::string& unit, double least,
              double most) {
  const double value = number(node, key, unit);
  if (!(value >= least && value <= most)) {
    node.at(key).refuse("a value in SI from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return value;
}

int whole(const YamlNode& node, const std::string& key, int least, int most) {
  const YamlNode at = node.at(key);
  const double value = at.number();
  if (value != static_cast<int>(value) || value < least || value > most) {
    at.refuse("a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return static_cast<int>(value);
}

RequiredShare read_share(const YamlNode& node) {
  RequiredShare share;
  share.runs = whole(node, "runs", 1, 100000);
  share.at_least = ranged(node, "at_least", "1", 0.0, 1.0);
  return share;
}

RequiredQuantity read_quantity(const YamlNode& node) {
  node.allow_keys({"name", "measure", "from", "to"});
  RequiredQuantity quantity;
  quantity.name = node.at("name").text();
  quantity.measure = read_measure(node.at("measure"));
  if (!node.has("from") && !node.has("to")) {
    node.refuse("from, to or both");
  }
  for (const char* key : {"from", "to"}) {
    const std::optional<YamlNode> limit = node.find(key);
    if (!limit) {
      continue;
    }
    quantity.unit = limit->at("unit").text();
    quantity.factor = to_si_factor(quantity.unit);
    model::QuantityRule rule;
    rule.unit = quantity.unit;
    const double value = model::read_quantity(*limit, rule).value;
    quantity.source = model::read_origin(*limit).text;
    (std::string(key) == "from" ? quantity.from : quantity.to) = value;
  }
  return quantity;
}

RequiredPublished read_named(const YamlNode& node) {
  node.allow_keys({"file", "gait", "names"});
  RequiredPublished published;
  published.file = resolved(node.at("file"));
  published.gait = node.at("gait").text();
  published.where = node.at("names").place();
  for (const YamlNode& one : node.at("names").items()) {
    published.names.push_back(one.text());
  }
  return published;
}

/// A published number with its tolerance as a range.
RequiredQuantity range_of(const PublishedQuantity& published) {
  RequiredQuantity quantity;
  quantity.name = published.name;
  quantity.measure = published.measure;
  quantity.unit = published.quantity.unit;
  quantity.factor = to_si_factor(quantity.unit);
  quantity.source = published.quantity.source;
  quantity.foot = published.foot;
  const double value = published.quantity.value, tolerance = published.tolerance.value;
  if (published.relation != PublishedQuantity::Relation::at_most) quantity.from = value - tolerance;
  if (published.relation != PublishedQuantity::Relation::at_least) quantity.to = value + tolerance;
  return quantity;
}

void read_required(const YamlNode& node, Requirements& r) {
  node.allow_keys({"published", "quantities", "starts", "robots", "noise", "wire", "terrain", "multiplier",
                   "command_margin", "workspace_margin", "step_time", "allocations"});
  if (const auto published = node.find("published")) {
    for (const YamlNode& one : published->items()) {
      r.published.push_back(read_named(one));
    }
  }
  if (const auto quantities = node.find("quantities")) {
    for (const YamlNode& one : quantities->items()) {
      r.quantities.push_back(read_quantity(one));
    }
  }
  const YamlNode starts = node.at("starts");
  starts.allow_keys({"runs", "at_least"});
  r.starts = read_share(starts);
  if (const auto robots = node.find("robots")) {
    robots->allow_keys({"runs", "at_least", "share"});
    r.robots = read_share(*robots);
    r.robots_share = robots->has("share") ? ranged(*robots, "share", "1", 0.0, 0.5) : 0.0;
  }
  if (const auto noise = node.find("noise")) {
    noise->allow_keys({"runs", "at_least", "counts"});
    r.noise = read_share(*noise);
    r.noise_counts = ranged(*noise, "counts", "1", 0.0, 1000.0);
  }
  if (const auto wire = node.find("wire")) {
    wire->allow_keys({"runs", "at_least", "lost", "late"});
    r.wire.emplace();
    static_cast<RequiredShare&>(*r.wire) = read_share(*wire);
    r.wire->lost = ranged(*wire, "lost", "1", 0.0, 1.0);
    r.wire->late = ranged(*wire, "late", "1", 0.0, 1.0);
  }
  if (const auto terrain = node.find("terrain")) {
    terrain->allow_keys({"runs", "at_least", "length", "height", "level"});
    r.terrain.emplace();
    static_cast<RequiredShare&>(*r.terrain) = read_share(*terrain);
    r.terrain->length = ranged(*terrain, "length", "m", 1e-3, 100.0);
    r.terrain->height = ranged(*terrain, "height", "m", 0.0, 1.0);
    r.terrain->level =
        terrain->has("level") ? ranged(*terrain, "level", "m", 0.0, 100.0) : 0.5 * r.terrain->length;
  }
  if (node.has("multiplier")) r.multiplier = ranged(node, "multiplier", "1", 0.0, 100.0);
  if (node.has("command_margin")) r.command_margin = ranged(node, "command_margin", "1", 0.0, 1.0);
  if (node.has("workspace_margin")) r.workspace_margin = ranged(node, "workspace_margin", "1", 0.0, 0.5);
  if (node.has("step_time")) r.step_time = ranged(node, "step_time", "s", 1e-9, 1.0);
  if (node.has("allocations")) {
    whole(node, "allocations", 0, 0);
    r.no_allocation = true;
  }
}

/// Channels by name until the model is known.
driver::Reach read_reach(const YamlNode& node, bool predicted, std::vector<std::vector<std::string>>& names) {
  node.allow_keys(predicted ? std::vector<std::string>{"name", "of", "from", "to", "deceleration"}
                            : std::vector<std::string>{"name", "of", "from", "to"});
  driver::Reach reach;
  reach.name = node.at("name").text();
  names.emplace_back();
  for (const auto& [sensor, factor] : node.at("of").entries()) {
    names.back().push_back(sensor);
    reach.of.push_back({0, factor.number()});
  }
  reach.from = number(node, "from", "rad");
  reach.to = number(node, "to", "rad");
  if (!(reach.from < reach.to)) {
    node.at("to").refuse("an angle above from");
  }
  if (predicted) {
    reach.deceleration = ranged(node, "deceleration", "rad/s^2", 1e-6, 1e9);
  }
  return reach;
}

int channel_index(const driver::Plan& plan, const std::string& name, const YamlNode& node) {
  const std::vector<std::string> names = plan.channel_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k] == name) {
      return static_cast<int>(k);
    }
  }
  node.refuse("\"" + name + "\"", "a sensor of the model" + nearest_names(name, names));
}

void read_reaches(const YamlNode& node, bool predicted, const driver::Plan& plan,
                  std::vector<driver::Reach>& to) {
  for (const YamlNode& one : node.items()) {
    std::vector<std::vector<std::string>> names;
    driver::Reach reach = read_reach(one, predicted, names);
    for (std::size_t k = 0; k < reach.of.size(); ++k) {
      reach.of[k].channel = channel_index(plan, names.back()[k], one.at("of"));
    }
    to.push_back(reach);
  }
}

void read_hold(const YamlNode& node, driver::Plan& plan) {
  for (const auto& [motor, entry] : node.entries()) {
    const std::vector<std::string> motors = plan.command_names();
    std::size_t index = 0;
    while (index < motors.size() && motors[index] != motor) {
      ++index;
    }
    if (index == motors.size()) {
      node.refuse("\"" + motor + "\"", "a motor of the model" + nearest_names(motor, motors));
    }
    entry.allow_keys({"sensor", "stiffness", "damping"});
    driver::Hold& hold = plan.commands[index].hold;
    hold.channel = channel_index(plan, entry.at("sensor").text(), entry.at("sensor"));
    hold.stiffness = ranged(entry, "stiffness", "N m/rad", 0.0, 1e9);
    hold.damping = ranged(entry, "damping", "N m s/rad", 0.0, 1e9);
  }
}

void read_tolerances(const YamlNode& drive, driver::Plan& plan) {
  const YamlNode packets = drive.at("packets");
  packets.allow_keys({"lost_in_succession", "lost", "duplicated", "reordered", "corrupt"});
  plan.packets.lost_in_succession = whole(packets, "lost_in_succession", 0, 1000);
  plan.packets.lost = whole(packets, "lost", 0, 1000);
  plan.packets.duplicated = whole(packets, "duplicated", 0, 1000);
  plan.packets.reordered = whole(packets, "reordered", 0, 1000);
  plan.packets.corrupt = whole(packets, "corrupt", 0, 1000);
  const YamlNode times = drive.at("times");
  times.allow_keys({"silence", "answer", "late", "controller"});
  plan.silence = ranged(times, "silence", "s", plan.period, 10.0);
  plan.answer = ranged(times, "answer", "s", 1e-6, 10.0);
  plan.late = whole(times, "late", 0, 1000);
  plan.controller_time = ranged(times, "controller", "s", 1e-6, 10.0);
}

void fill_channels(const model::Model& model, driver::Plan& plan) {
  for (const model::Sensor& sensor : model.sensors) {
    driver::Channel channel;
    channel.name = sensor.name;
    channel.unit = model::reading_unit(model, sensor.name);
    channel.kind = sensor.resolution > 0.0 ? driver::ChannelKind::count : driver::ChannelKind::value;
    channel.scale = sensor.resolution > 0.0 ? sensor.resolution : 1.0;
    plan.channels.push_back(channel);
  }
  for (const model::ContactSwitch& one : model.switches) {
    driver::Channel channel;
    channel.name = one.name;
    channel.unit = "1";
    channel.kind = driver::ChannelKind::contact;
    plan.channels.push_back(channel);
  }
}

/// The first of a port's wires that the robot's packet can serve.
driver::Plan::Input input_of(const run::LoadedScenario& loaded, const driver::Plan& plan,
                             const plumbline_port& port, const std::vector<run::InputWire>& wires) {
  using Kind = run::InputWire::Kind;
  const model::Model& model = loaded.model;
  driver::Plan::Input input;
  input.port = port.name;
  for (const run::InputWire& wire : wires) {
    if (wire.kind == Kind::fixed) {
      input.fixed = wire.value;
      return input;
    }
    if (wire.kind == Kind::foot) {
      for (std::size_t s = 0; s < model.switches.size(); ++s) {
        if (model.feet[static_cast<std::size_t>(model.switches[s].foot)].name == wire.name) {
          input.from.push_back(static_cast<int>(model.sensors.size() + s));
        }
      }
      if (!input.from.empty()) {
        return input;
      }
      continue;
    }
    for (std::size_t c = 0; c < plan.channels.size(); ++c) {
      if (plan.channels[c].name == wire.name) {
        input.from.push_back(static_cast<int>(c));
        input.scale = plan.channels[c].scale / wire.divide_by;
        return input;
      }
    }
  }
  throw InputError(loaded.controller->where, std::string("no wire of ") + port.name,
                   "one that is a sensor or a switch of the robot");
}

}  // namespace

Requirements read_requirements(const std::string& path) {
  const Chain file(path);
  Requirements r;
  r.file = path;
  r.title = file.at("title").text();
  r.scenario = resolved(file.at("scenario"));
  r.valid_until = file.at("valid_until").text();
  r.seed = static_cast<std::uint64_t>(whole(file.of("seed"), "seed", 0, 1000000000));
  r.cycles = whole(file.of("cycles"), "cycles", 1, 1000000);
  if (const auto reference = file.of("reference").find("reference")) {
    for (const YamlNode& one : reference->items()) {
      r.reference.push_back(resolved(one));
    }
  }
  read_required(file.at("required"), r);
  return r;
}

void add_published(Requirements& r) {
  for (const RequiredPublished& wanted : r.published) {
    PublishedOptions options;
    options.gait = wanted.gait;
    options.scenario = r.scenario;
    const PublishedGait gait = read_published(wanted.file, options).gaits.front();
    std::vector<std::string> known;
    for (const PublishedQuantity& one : gait.quantities) {
      if (one.measure.of() == Measure::Of::cycle && one.controller.empty()) known.push_back(one.name);
    }
    for (const std::string& name : wanted.names) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        throw InputError(
            wanted.where, "\"" + name + "\"",
            "a quantity of " + wanted.file + " that is measured on cycles" + nearest_names(name, known));
      }
      for (const PublishedQuantity& one : gait.quantities) {
        if (one.name == name) r.quantities.push_back(range_of(one));
      }
    }
    if (std::find(r.reference.begin(), r.reference.end(), wanted.file) == r.reference.end()) {
      r.reference.push_back(wanted.file);
    }
  }
}

void complete_drive(Requirements& r, const run::LoadedScenario& loaded) {
  const YamlNode drive = Chain(r.file).at("drive");
  drive.allow_keys(
      {"speed_times", "rest_times", "slew_times", "workspace", "handover", "hold", "packets", "times"});
  if (!loaded.controller) {
    throw InputError({r.file, 0, "scenario"}, "a scenario without a controller",
                     "one whose controller is to be certified");
  }
  const run::ControllerSetup& setup = *loaded.controller;
  driver::Plan& plan = r.drive;
  plan.title = r.title;
  plan.robot = loaded.model.robot;
  plan.period = setup.period;
  fill_channels(loaded.model, plan);
  for (const model::Motor& motor : loaded.model.motors) {
    driver::CommandChannel command;
    command.name = motor.name;
    command.unit = motor.command_unit;
    plan.commands.push_back(command);
  }
  const std::vector<plumbline_port> inputs = setup.library.inputs(), outputs = setup.library.outputs();
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    plan.inputs.push_back(input_of(loaded, plan, inputs[k], setup.inputs[k]));
  }
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const int motor = loaded.model.motor_index(setup.outputs[k]);
    plan.outputs.push_back({outputs[k].name, motor});
    plan.commands[static_cast<std::size_t>(motor)].limit =
        std::max(std::abs(outputs[k].lower), std::abs(outputs[k].upper));
  }
  for (driver::CommandChannel& command : plan.commands) {
    if (!(command.limit > 0.0) || command.limit == driver::kNone) {
      throw InputError(setup.file + ": the controller states no largest command of motor " + command.name);
    }
  }
  for (const plumbline_port& port : setup.library.log()) {
    plan.log.emplace_back(port.name);
  }
  const std::vector<plumbline_port> constants = setup.library.constants();
  for (std::size_t k = 0; k < constants.size(); ++k) {
    plan.constant_names.emplace_back(constants[k].name);
    plan.constants.push_back(setup.constants[k]);
  }
  plan.controller = setup.library.api().name;
  plan.controller_version = setup.library.api().version;
  r.speed_times = ranged(drive, "speed_times", "1", 1.0, 100.0);
  r.rest_times = ranged(drive, "rest_times", "1", 1.0, 100.0);
  r.slew_times = ranged(drive, "slew_times", "1", 1.0, 100.0);
  read_reaches(drive.at("workspace"), true, plan, plan.workspace);
  read_reaches(drive.at("handover"), false, plan, plan.handover);
  read_hold(drive.at("hold"), plan);
  read_tolerances(drive, plan);
}

}  // namespace plumbline::validation
