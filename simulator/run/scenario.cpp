#include "simulator/run/scenario.h"

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/plain_number.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/terrain_file.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/trace/error.h"
#include "simulator/trace/units.h"

namespace plumbline::run {
namespace {

using model::YamlNode;

constexpr const char* kScenarioFormat = "scenario/1";

YamlNode needed(const std::vector<YamlNode>& chain, const std::string& key) {
  const auto found = model::find_newest(chain, key);
  return found ? *found : chain.back().at(key);
}

Quantity read_quantity(const std::string& name, const YamlNode& node, const model::Model& model) {
  node.allow_keys({"of", "sine", "times", "divide_by"});
  Quantity quantity;
  quantity.name = name;
  const YamlNode of = node.at("of");
  quantity.of = of.text();
  quantity.unit = model::position_unit_of(model, quantity.of, of);
  if (const auto sine = node.find("sine")) {
    if (sine->text() != "true" && sine->text() != "false") {
      sine->refuse("true or false");
    }
    quantity.sine = sine->text() == "true";
  }
  const auto times = node.find("times");
  const auto divide = node.find("divide_by");
  if (times && divide) {
    divide->refuse("both times and divide_by", "one of them");
  }
  if (const auto factor = times ? times : divide) {
    const std::string unit = factor->at("unit").text();
    const double number = model::read_number(*factor, unit);
    if (number == 0.0) {
      factor->refuse("a number that is not 0");
    }
    quantity.times = times ? number : 1.0 / number;
    quantity.unit = "(" + quantity.unit + (times ? ")*(" : ")/(") + unit + ")";
    for (const char* simple : {"m", "rad"}) {
      quantity.unit = units_agree(quantity.unit, simple) ? simple : quantity.unit;
    }
  }
  return quantity;
}

const Quantity* find_quantity(const Scenario& scenario, const std::string& name) {
  for (const Quantity& quantity : scenario.quantities) {
    if (quantity.name == name) {
      return &quantity;
    }
  }
  return nullptr;
}

/// A named position or quantity: what it is a multiple of, and its unit.
struct Target {
  std::string position;
  std::string unit;
  double times = 1.0;
};

Target target_of(const std::string& name, const YamlNode& node, const Scenario& scenario,
                 const model::Model& model, bool sine_too) {
  if (const Quantity* quantity = find_quantity(scenario, name)) {
    if (quantity->sine && !sine_too) {
      node.refuse(model::quote(name) + ", a sine", "a position, or a multiple of one");
    }
    return {quantity->of, quantity->unit, quantity->times};
  }
  return {name, model::position_unit_of(model, name, node), 1.0};
}

std::vector<Named> read_named(const YamlNode& section, const char* per, const Scenario& scenario,
                              const model::Model& model) {
  std::vector<Named> all;
  for (const auto& [name, node] : section.entries()) {
    const Target target = target_of(name, node, scenario, model, false);
    all.emplace_back(target.position, model::read_number(node, target.unit + per) / target.times);
  }
  return all;
}

Start read_start(const YamlNode& node, const Scenario& scenario, const model::Model& model) {
  node.allow_keys({"positions", "velocities", "clearance"});
  Start start;
  if (const auto positions = node.find("positions")) {
    start.positions = read_named(*positions, "", scenario, model);
  }
  if (const auto velocities = node.find("velocities")) {
    start.velocities = read_named(*velocities, "/s", scenario, model);
  }
  if (const auto clearance = node.find("clearance")) {
    start.clearance = model::read_number(*clearance, "m", {"of"});
    const YamlNode of = clearance->at("of");
    const Target target = target_of(of.text(), of, scenario, model, true);
    start.height = target.position;
    start.height_arm = target.times;
    if (model.feet.empty()) {
      clearance->refuse("a robot without feet", "a model with feet");
    }
  }
  return start;
}

Drawn read_drawn(const YamlNode& node, const Scenario& scenario, const model::Model& model) {
  node.allow_keys({"what", "of", "from", "to", "added"});
  Drawn drawn;
  const YamlNode what = node.at("what");
  std::string unit = "m";
  if (what.text() == "clearance") {
    drawn.of = Drawn::Of::clearance;
    if (scenario.start.height.empty()) {
      what.refuse("clearance, which start does not state", "it there, too");
    }
  } else if (what.text() == "position" || what.text() == "velocity") {
    drawn.of = what.text() == "position" ? Drawn::Of::position : Drawn::Of::velocity;
    const YamlNode of = node.at("of");
    const Target target = target_of(of.text(), of, scenario, model, false);
    drawn.name = target.position;
    drawn.times = target.times;
    unit = target.unit + (drawn.of == Drawn::Of::velocity ? "/s" : "");
  } else {
    what.refuse("position, velocity or clearance");
  }
  drawn.from = model::read_number(node.at("from"), unit);
  drawn.to = model::read_number(node.at("to"), unit);
  if (!(drawn.from <= drawn.to)) {
    node.refuse("a range that ends before it begins", "from <= to");
  }
  if (const auto added = node.find("added")) {
    drawn.added = added->text() == "true";
  }
  return drawn;
}

End read_limit(const YamlNode& node, End::Kind kind, const char* key, const Scenario& scenario,
               const model::Model& model) {
  node.allow_keys({"of", "above", "below", "says"});
  End end;
  end.kind = kind;
  const YamlNode of = node.at("of");
  const Quantity* quantity = find_quantity(scenario, of.text());
  const Target target = target_of(of.text(), of, scenario, model, true);
  end.watched = target.position;
  end.limit = model::read_number(node.at(key), target.unit) / target.times;
  if (quantity != nullptr && quantity->sine) {
    if (std::abs(end.limit) > 1.0) {
      node.refuse("a height that " + quantity->name + " never has", "one that it can have");
    }
    end.limit = std::asin(end.limit);
  }
  end.words = node.at("says").text();
  return end;
}

End read_end(const YamlNode& node, const Scenario& scenario, const model::Model& model) {
  End end;
  if (node.has("above")) {
    return read_limit(node, End::Kind::above, "above", scenario, model);
  }
  if (node.has("below")) {
    return read_limit(node, End::Kind::below, "below", scenario, model);
  }
  if (const auto ground = node.find("on_ground_for")) {
    node.allow_keys({"on_ground_for"});
    end.kind = End::Kind::on_ground;
    end.limit = model::read_positive(*ground, "s");
  } else if (const auto unchanged = node.find("unchanged_for")) {
    node.allow_keys({"log", "unchanged_for"});
    end.kind = End::Kind::unchanged;
    end.watched = node.at("log").text();
    end.limit = model::read_positive(*unchanged, "s");
  } else if (const auto fault = node.find("after_fault")) {
    node.allow_keys({"after_fault"});
    end.kind = End::Kind::after_fault;
    end.limit = model::read_positive(*fault, "s");
  } else {
    node.refuse("an end with one of above, below, on_ground_for, unchanged_for and after_fault");
  }
  return end;
}

ScenarioFiles files_of(const std::vector<YamlNode>& chain) {
  ScenarioFiles files;
  const YamlNode model = needed(chain, "model");
  files.model = model::beside(model.file(), model.text());
  if (const auto controller = model::find_newest(chain, "controller")) {
    files.controller = model::beside(controller->file(), controller->text());
  }
  return files;
}

void read_sections(const std::vector<YamlNode>& chain, const model::Model& model, Scenario& scenario) {
  if (const auto quantities = model::find_newest(chain, "quantities")) {
    for (const auto& [name, node] : quantities->entries()) {
      scenario.quantities.push_back(read_quantity(name, node, model));
    }
  }
  if (const auto terrain = model::find_newest(chain, "terrain")) {
    scenario.terrain = model::read_terrain(*terrain);
  }
  scenario.longest = model::read_positive(needed(chain, "length"), "s");
  if (const auto start = model::find_newest(chain, "start")) {
    scenario.start = read_start(*start, scenario, model);
  }
  if (const auto vary = model::find_newest(chain, "vary")) {
    for (const YamlNode& node : vary->items()) {
      scenario.drawn.push_back(read_drawn(node, scenario, model));
    }
  }
  if (const auto ends = model::find_newest(chain, "ends")) {
    for (const YamlNode& node : ends->items()) {
      scenario.ends.push_back(read_end(node, scenario, model));
    }
  }
}

}  // namespace

double Quantity::value(const model::Plant& plant, const double* x) const {
  const double position = plant.position_of(of, x);
  return times * (sine ? std::sin(position) : position);
}

std::optional<YamlNode> section_of_scenario(const std::string& path, const std::string& key) {
  return model::find_newest(model::read_chain(path, kScenarioFormat), key);
}

ScenarioFiles files_of_scenario(const std::string& path) {
  return files_of(model::read_chain(path, kScenarioFormat));
}

LoadedScenario read_scenario(const std::string& path, const ScenarioFiles& in_place) {
  const std::vector<YamlNode> chain = model::read_chain(path, kScenarioFormat);
  for (const YamlNode& document : chain) {
    document.allow_keys({"plumbline", "base", "title", "note", "model", "controller", "length", "terrain",
                         "quantities", "start", "vary", "ends", "gait"});
  }
  const ScenarioFiles files = files_of(chain);
  LoadedScenario loaded;
  Scenario& scenario = loaded.scenario;
  scenario.file = path;
  scenario.title = needed(chain, "title").text();
  scenario.model = in_place.model.empty() ? files.model : in_place.model;
  scenario.controller = in_place.controller.empty() ? files.controller : in_place.controller;
  loaded.model = model::read_model(scenario.model, model::known_effects());
  read_sections(chain, loaded.model, scenario);
  if (!scenario.controller.empty()) {
    loaded.controller = read_controller(scenario.controller);
  }
  return loaded;
}

}  // namespace plumbline::run
