#include "validation/identify/twin/experiment.h"

#include <algorithm>
#include <cmath>

#include "simulator/model/kinds.h"
#include "simulator/model/yaml_node.h"
#include "simulator/trace/number_text.h"
#include "validation/identify/trial/physical_number.h"
#include "validation/identify/trial/trial_file.h"
#include "validation/identify/twin/excitation_file.h"

namespace plumbline::validation {
namespace {

using model::Model;
using model::YamlNode;

constexpr double kFewestSamples = 20;
constexpr double kMostSamples = 1e8;

double read_positive_time(const YamlNode& node, const std::string& what) {
  const double value = read_physical(node, "s", what);
  if (value <= 0.0) {
    node.refuse(number_text(value) + " s", "a time above zero");
  }
  return value;
}

Sampling read_sampling(const YamlNode& root) {
  const YamlNode duration_node = root.at("duration");
  const double duration = read_positive_time(duration_node, "the duration");
  const double period = read_positive_time(root.at("sample_period"), "the sample period");
  const double count = std::round(duration / period);
  if (count < kFewestSamples || count > kMostSamples) {
    duration_node.refuse(number_text(duration) + " s, which is " + number_text(count) + " samples",
                         "20 samples or more, 1e8 at most");
  }
  if (std::abs(count * period - duration) > 1e-6 * period) {
    duration_node.refuse(number_text(duration) + " s",
                         "a whole number of sample periods of " + number_text(period) + " s");
  }
  return {period, static_cast<Eigen::Index>(count)};
}

std::vector<Start> read_start(const YamlNode& node, const Model& model) {
  std::vector<Start> start;
  for (const auto& [name, entry] : node.entries()) {
    const std::string unit = placed_unit(entry, name, model);
    if (model.find_motor(name) != nullptr) {
      entry.refuse("motor " + model::quote(name), "coordinates; a motor starts where its coordinates put it");
    }
    start.push_back({name, read_physical(entry, unit, name)});
  }
  return start;
}

std::vector<std::string> read_locked(const YamlNode& node, const Model& model) {
  std::vector<std::string> locked;
  for (const YamlNode& item : node.items()) {
    const std::string name = item.text();
    placed_unit(item, name, model);
    if (std::find(locked.begin(), locked.end(), name) != locked.end()) {
      item.refuse(model::quote(name) + " a second time", "each name once");
    }
    locked.push_back(name);
  }
  return locked;
}

std::vector<Command> read_commands(const YamlNode& node, const Model& model, const Sampling& sampling) {
  std::vector<Command> commands;
  for (const auto& [name, list] : node.entries()) {
    const std::string& unit = known_motor(list, name, model).command_unit;
    const Excitations shapes = read_excitations(list, unit, name, sampling);
    commands.push_back({name, "u_" + name, unit, sampled_sum(shapes, sampling)});
  }
  if (commands.empty()) {
    node.refuse("an empty map", "at least one motor");
  }
  return commands;
}

std::vector<Controller> read_controllers(const YamlNode& node, const Model& model, const Sampling& sampling) {
  std::vector<Controller> controllers;
  for (const YamlNode& item : node.items()) {
    item.allow_keys({"kind", "motor", "sensor", "reference", "position_gain", "velocity_gain",
                     "command_limit", "velocity_over"});
    Controller one = read_controller_law(item, model);
    const auto same = [&](const Controller& other) { return other.motor == one.motor; };
    if (std::any_of(controllers.begin(), controllers.end(), same)) {
      item.refuse("a second controller of motor " + one.motor, "one for each motor");
    }
    const Excitations shapes = read_excitations(item.at("reference"), model::reading_unit(model, one.sensor),
                                                "sensor " + one.sensor, sampling);
    one.reference = sampled_sum(shapes, sampling);
    controllers.push_back(std::move(one));
  }
  return controllers;
}

/// Every motor that is commanded has a command, and every controller adds what is commanded of its motor.
void join(const Model& model, Experiment& experiment) {
  for (Controller& controller : experiment.controllers) {
    const auto of_it = [&](const Command& command) { return command.motor == controller.motor; };
    const auto found = std::find_if(experiment.commands.begin(), experiment.commands.end(), of_it);
    if (found != experiment.commands.end()) {
      controller.disturbance = found->values;
      continue;
    }
    experiment.commands.push_back({controller.motor, "u_" + controller.motor,
                                   model.find_motor(controller.motor)->command_unit,
                                   Eigen::VectorXd::Zero(experiment.time.size())});
  }
}

Experiment experiment_from(const YamlNode& root, const Model& model) {
  check_format(root, "experiment/1");
  root.allow_keys({"plumbline", "title", "role", "duration", "sample_period", "start", "locked", "commands",
                   "controllers"});
  const Sampling sampling = read_sampling(root);
  Experiment experiment;
  experiment.file = root.file();
  experiment.title = root.at("title").text();
  experiment.role = read_role(root.at("role"));
  experiment.duration = sampling.duration();
  experiment.period = sampling.period;
  experiment.time = Eigen::VectorXd::LinSpaced(sampling.count, 0.0, static_cast<double>(sampling.count - 1)) *
                    sampling.period;
  if (const auto start = root.find("start")) {
    experiment.start = read_start(*start, model);
  }
  if (const auto locked = root.find("locked")) {
    experiment.locked = read_locked(*locked, model);
  }
  if (const auto controllers = root.find("controllers")) {
    experiment.controllers = read_controllers(*controllers, model, sampling);
  }
  if ((experiment.controllers.empty() && !model.motors.empty()) || root.has("commands")) {
    experiment.commands = read_commands(root.at("commands"), model, sampling);
  }
  join(model, experiment);
  return experiment;
}

}  // namespace

Experiment read_experiment(const std::string& path, const Model& model) {
  return experiment_from(YamlNode::load(path), model);
}

Experiment parse_experiment(const std::string& text, const std::string& name, const Model& model) {
  return experiment_from(YamlNode::parse(text, name), model);
}

}  // namespace plumbline::validation
