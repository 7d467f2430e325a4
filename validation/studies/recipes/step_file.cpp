#include "validation/studies/recipes/step_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "simulator/model/kinds.h"
#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "validation/identify/trial/physical_number.h"
#include "validation/identify/trial/trial_file.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

using model::QuantityRule;
using model::YamlNode;
using Sign = QuantityRule::Sign;

template <typename Named>
std::vector<std::string> names(const std::vector<Named>& all) {
  std::vector<std::string> list;
  list.reserve(all.size());
  for (const Named& one : all) {
    list.push_back(one.name);
  }
  return list;
}

std::string known_sensor(const YamlNode& node, const model::Model& model) {
  return known_name(node, names(model.sensors), "sensor");
}

/// Unknowns that the step's model links.
std::vector<std::string> read_unknowns(const std::optional<YamlNode>& list, const Recipe& recipe,
                                       const LinkedModel& linked) {
  std::vector<std::string> all;
  for (const YamlNode& item : list ? list->items() : std::vector<YamlNode>{}) {
    const std::string name = known_name(item, names(recipe.unknowns), "unknown");
    const bool is_linked = std::any_of(linked.links.begin(), linked.links.end(),
                                       [&](const Link& link) { return link.unknown == name; });
    if (!is_linked) {
      item.refuse(model::quote(name),
                  "an unknown that model " + model::quote(linked.name) + " links to a parameter");
    }
    if (std::find(all.begin(), all.end(), name) != all.end()) {
      item.refuse(model::quote(name) + " a second time", "each unknown once");
    }
    all.push_back(name);
  }
  return all;
}

void read_known(const YamlNode& node, const Recipe& recipe, const std::set<std::string>& given, Step& step) {
  const auto list = node.find("known");
  step.known = read_unknowns(list, recipe, recipe.model(step.model));
  for (std::size_t i = 0; i < step.known.size(); ++i) {
    const std::string& name = step.known[i];
    if (given.count(name) == 0 && !recipe.unknown(name).stated) {
      list->items()[i].refuse(model::quote(name),
                              "an unknown that an earlier step estimates, or one with `stated`");
    }
    if (std::find(step.free.begin(), step.free.end(), name) != step.free.end()) {
      list->items()[i].refuse(model::quote(name) + ", which is free too", "each unknown in one list");
    }
  }
}

RunsMethod read_runs(const YamlNode& node) {
  node.allow_keys({"scenario", "starts", "from", "to"});
  RunsMethod runs;
  runs.scenario = existing_file(node.at("scenario"));
  const double starts = node.at("starts").number();
  if (!(starts >= 1.0 && starts <= 1000.0) || starts != std::floor(starts)) {
    node.at("starts").refuse("a whole number from 1 to 1000");
  }
  runs.starts = static_cast<int>(starts);
  runs.from = read_physical(node.at("from"), "s", "the time");
  runs.to = read_physical(node.at("to"), "s", "the time");
  if (!(runs.to > runs.from) || runs.from < 0.0) {
    node.at("to").refuse("a time above `from`");
  }
  return runs;
}

Postures read_postures(const YamlNode& node, const model::Model& model) {
  node.allow_keys({"locked", "balanced", "hand", "scale", "poses"});
  Postures postures;
  for (const YamlNode& item : node.at("locked").items()) {
    const std::string name = item.text();
    placed_unit(item, name, model);
    if (std::none_of(model.sensors.begin(), model.sensors.end(),
                     [&](const model::Sensor& sensor) { return sensor.measures == name; })) {
      item.refuse(model::quote(name), "something that a sensor of the model measures");
    }
    postures.locked.push_back(name);
  }
  if (const auto balanced = node.find("balanced")) {
    postures.balanced = balanced->text();
    const std::string unit = placed_unit(*balanced, postures.balanced, model);
    postures.hand = model::read_quantity(node.at("hand"), {unit, Sign::positive, false, {}}).value;
  }
  if (const auto scale = node.find("scale")) {
    postures.scale_resolution = model::read_quantity(*scale, {"N", Sign::positive, false, {}}).value;
  }
  for (const YamlNode& item : node.at("poses").items()) {
    Postures::Pose pose;
    for (const auto& [name, value] : item.entries()) {
      const std::string unit = placed_unit(value, name, model);
      pose.at.emplace_back(name, read_physical_text(value, unit, name));
    }
    postures.poses.push_back(pose);
  }
  if (postures.poses.size() < 2) {
    node.at("poses").refuse(std::to_string(postures.poses.size()) + " poses", "two or more");
  }
  return postures;
}

/// Where the step's data come from: exactly one of the keys.
void read_data(const YamlNode& node, const Recipe& recipe, const std::vector<std::string>& keys, Step& step) {
  std::string found;
  for (const std::string& key : keys) {
    if (const auto entry = node.find(key)) {
      if (!found.empty()) {
        entry->refuse("this key beside `" + found + "`", "one source of data");
      }
      found = key;
    }
  }
  if (found.empty()) {
    std::string list;
    for (const std::string& key : keys) {
      list += (list.empty() ? "" : ", ") + key;
    }
    node.refuse("a step without data", "one of: " + list);
  }
  const model::Model& robot = recipe.model(step.robot).model;
  if (found == "data_of") {
    step.data_of = known_name(node.at(found), names(recipe.steps), "earlier step");
  } else if (found == "postures") {
    step.postures = read_postures(node.at(found), robot);
  } else if (found == "runs") {
    step.runs = read_runs(node.at(found));
  } else {
    std::vector<std::string>& files = found == "trials" ? step.trials : step.experiments;
    for (const YamlNode& item : node.at(found).items()) {
      files.push_back(existing_file(item));
    }
    if (files.empty()) {
      node.at(found).refuse("an empty list", "at least one file");
    }
  }
}

std::string optional_unknown(const YamlNode& node, const char* key, const Recipe& recipe) {
  const auto name = node.find(key);
  return name ? known_name(*name, names(recipe.unknowns), "unknown") : "";
}

void read_arx(const YamlNode& node, const Recipe& recipe, Step& step) {
  const model::Model& model = recipe.model(step.model).model;
  step.arx.motor = known_name(node.at("motor"), model::motor_names(model), "motor");
  step.arx.sensor = known_sensor(node.at("sensor"), model);
  step.arx.bias = known_name(node.at("bias"), names(recipe.unknowns), "unknown");
  step.arx.inertia = optional_unknown(node, "inertia", recipe);
  step.arx.friction = optional_unknown(node, "friction", recipe);
  step.free = {step.arx.bias};
  for (const std::string& name : {step.arx.inertia, step.arx.friction}) {
    if (!name.empty()) {
      step.free.push_back(name);
    }
  }
}

void read_equation_14(const YamlNode& node, const Recipe& recipe, const std::set<std::string>& given,
                      Step& step) {
  Equation14Method& method = step.equation_14;
  method.rotor_inertia =
      model::read_quantity(node.at("rotor_inertia"), {"kg m^2", Sign::positive, false, {}}).value;
  for (const YamlNode& item : node.at("rows").items()) {
    item.allow_keys({"lumped", "pulleys"});
    const std::string lumped = known_name(item.at("lumped"), names(recipe.unknowns), "unknown");
    if (given.count(lumped) == 0) {
      item.at("lumped").refuse(model::quote(lumped), "an unknown that an earlier step estimates");
    }
    const double pulleys =
        model::read_quantity(item.at("pulleys"), {"kg m^2", Sign::not_negative, false, {}}).value;
    method.rows.push_back({lumped, pulleys});
  }
  if (method.rows.size() < 2) {
    node.at("rows").refuse(std::to_string(method.rows.size()) + " rows", "two or more");
  }
  method.torque_factor = known_name(node.at("torque_factor"), names(recipe.unknowns), "unknown");
  method.rotor_factor = known_name(node.at("rotor_factor"), names(recipe.unknowns), "unknown");
  step.free = {method.torque_factor, method.rotor_factor};
}

void read_equation_22(const YamlNode& node, const Recipe& recipe, Step& step) {
  const model::Model& model = recipe.model(step.model).model;
  Equation22Method& method = step.equation_22;
  method.knee = known_sensor(node.at("knee"), model);
  method.spring = known_sensor(node.at("spring"), model);
  method.ratio = model::read_quantity(node.at("ratio"), {"1", Sign::positive, false, {}}).value;
  method.stiffness = known_name(node.at("stiffness"), names(recipe.unknowns), "unknown");
  method.preload = known_name(node.at("preload"), names(recipe.unknowns), "unknown");
  step.free = {method.stiffness, method.preload};
}

void read_models(const YamlNode& node, const Recipe& recipe, Step& step) {
  step.model = known_name(node.at("model"), names(recipe.models), "model");
  const auto robot = node.find("robot");
  step.robot = robot ? known_name(*robot, names(recipe.models), "model") : step.model;
}

void read_fit(const YamlNode& node, const Recipe& recipe, const std::set<std::string>& given, Step& step) {
  step.free = read_unknowns(node.at("free"), recipe, recipe.model(step.model));
  if (step.free.empty()) {
    node.at("free").refuse("an empty list", "at least one unknown");
  }
  read_known(node, recipe, given, step);
}

void read_window_fit(const YamlNode& node, const Recipe& recipe, const std::set<std::string>& given,
                     Step& step) {
  node.allow_keys({"step", "title", "source", "method", "carried", "model", "robot", "experiments", "trials",
                   "runs", "data_of", "window", "free", "known"});
  read_models(node, recipe, step);
  read_data(node, recipe, {"experiments", "trials", "runs", "data_of"}, step);
  if (const auto window = node.find("window")) {
    step.window = read_physical(*window, "s", "the window");
    if (!(step.window > 0.0)) {
      window->refuse("a time above zero");
    }
  }
  read_fit(node, recipe, given, step);
}

void read_method(const YamlNode& node, const Recipe& recipe, const std::set<std::string>& given, Step& step) {
  if (step.method == "window_fit" || step.method == "information") {
    read_window_fit(node, recipe, given, step);
  } else if (step.method == "posture_fit") {
    node.allow_keys({"step", "title", "source", "method", "carried", "model", "robot", "postures", "data_of",
                     "free", "known"});
    read_models(node, recipe, step);
    read_data(node, recipe, {"postures", "data_of"}, step);
    read_fit(node, recipe, given, step);
  } else if (step.method == "arx") {
    node.allow_keys({"step", "title", "source", "method", "carried", "model", "robot", "experiments",
                     "trials", "data_of", "motor", "sensor", "bias", "inertia", "friction"});
    read_models(node, recipe, step);
    read_data(node, recipe, {"experiments", "trials", "data_of"}, step);
    read_arx(node, recipe, step);
  } else if (step.method == "equation_14") {
    node.allow_keys({"step", "title", "source", "method", "carried", "rotor_inertia", "rows", "torque_factor",
                     "rotor_factor"});
    read_equation_14(node, recipe, given, step);
  } else {
    node.allow_keys({"step", "title", "source", "method", "carried", "model", "robot", "postures", "data_of",
                     "knee", "spring", "ratio", "stiffness", "preload"});
    read_models(node, recipe, step);
    read_data(node, recipe, {"postures", "data_of"}, step);
    read_equation_22(node, recipe, step);
  }
}

}  // namespace

std::vector<std::string> names_of(const std::vector<Unknown>& unknowns) { return names(unknowns); }

std::string known_name(const YamlNode& node, const std::vector<std::string>& names, const std::string& kind) {
  std::string name = node.text();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    node.refuse(model::quote(name), "the name of a " + kind + nearest_names(name, names));
  }
  return name;
}

std::string existing_file(const YamlNode& node) {
  std::string path = model::beside(node.file(), node.text());
  if (!fs::exists(path)) {
    node.refuse(model::quote(node.text()) + ", which is not there", "a file");
  }
  return path;
}

Step read_step(const YamlNode& node, const Recipe& recipe, std::set<std::string>& given) {
  Step step;
  step.place = node.place();
  step.name = node.at("step").text();
  const std::vector<std::string> before = names(recipe.steps);
  if (std::find(before.begin(), before.end(), step.name) != before.end()) {
    node.at("step").refuse(model::quote(step.name) + " a second time", "each step once");
  }
  step.title = node.at("title").text();
  step.source = node.at("source").text();
  step.method =
      known_name(node.at("method"),
                 {"window_fit", "information", "posture_fit", "arx", "equation_14", "equation_22"}, "method");
  step.carried = step.method != "information";
  if (const auto carried = node.find("carried")) {
    const std::string text = known_name(*carried, {"yes", "no"}, "choice");
    if (text == "yes" && step.method == "information") {
      carried->refuse("\"yes\" for a step that recovers nothing", "no");
    }
    step.carried = text == "yes";
  }
  read_method(node, recipe, given, step);
  if (step.carried) {
    given.insert(step.free.begin(), step.free.end());
    given.insert(step.known.begin(), step.known.end());
  }
  return step;
}

}  // namespace plumbline::validation
