#include <fmt/core.h>

#include "simulator/model/kinds.h"
#include "simulator/model/plant.h"
#include "validation/cli/describe.h"
#include "validation/cli/files.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

using model::Model;
using model::Quantity;
using nlohmann::json;
using Rows = std::vector<std::vector<std::string>>;

bool sensor_is_angular(const Model& model, const std::string& sensor) {
  return model.place_is_angular(effects::Place::sensor, sensor);
}

std::string kind_of(bool angular) { return angular ? "rotary" : "linear"; }

/// "hip + 0.5 knee"
std::string sum_text(const std::vector<model::Term>& terms) {
  std::string text;
  for (const model::Term& term : terms) {
    text += (text.empty() ? "" : " + ") +
            (term.factor == 1.0 ? term.of : fmt::format("{:g} {}", term.factor, term.of));
  }
  return text;
}

std::string origin_text(const Quantity& quantity) {
  return (quantity.assumed ? "assumed: " : "") + quantity.source;
}

/// The unit of a law's parameter where the effect sits.
std::string unit_of(const Model& model, const model::EffectUse& use, std::size_t parameter) {
  const bool angular = model.place_is_angular(model.resolve(*use.law, use.at), use.at);
  return effects::unit_at(use.law->declaration().parameters[parameter].unit, angular);
}

json to_json(const Quantity& quantity, const std::string& unit) {
  return {{"value", json_number(quantity.value)},
          {"standard_deviation", quantity.uncertainty},
          {"unit", unit},
          {"source", quantity.source},
          {"assumed", quantity.assumed}};
}

json terms_json(const std::vector<model::Term>& terms) {
  json factors = json::object();
  for (const model::Term& term : terms) {
    factors[term.of] = term.factor;
  }
  return factors;
}

json effects_json(const Model& model) {
  json list = json::array();
  for (const model::EffectUse& use : model.effects) {
    json values = json::object();
    for (std::size_t p = 0; p < use.values.size(); ++p) {
      values[use.law->declaration().parameters[p].name] = to_json(use.values[p], unit_of(model, use, p));
    }
    list.push_back({{"effect", use.law->declaration().name}, {"at", use.at}, {"values", values}});
  }
  return list;
}

const std::vector<effects::Place>& all_places() {
  static const std::vector<effects::Place> kPlaces{
      effects::Place::coordinate, effects::Place::motor, effects::Place::ratio, effects::Place::body,
      effects::Place::sensor,     effects::Place::world, effects::Place::foot};
  return kPlaces;
}

json bodies_json(const Model& model) {
  json list = json::array();
  for (const model::Body& body : model.skeleton.bodies) {
    list.push_back({{"name", body.name}, {"mass", body.mass}, {"standard_deviation", body.mass_uncertainty}});
  }
  return list;
}

json coordinates_json(const Model& model) {
  json list = json::array();
  for (const model::Coordinate& coordinate : model.coordinates) {
    list.push_back({{"name", coordinate.name},
                    {"unit", model::position_unit(coordinate.angular)},
                    {"of", terms_json(coordinate.terms)}});
  }
  return list;
}

json motors_json(const Model& model) {
  json list = json::array();
  for (const model::Motor& motor : model.motors) {
    const std::string force = model::force_unit(motor.angular);
    const bool limited = motor.torque_limit.value > 0.0;
    list.push_back(
        {{"name", motor.name},
         {"command_unit", motor.command_unit},
         {"rotor_inertia", to_json(motor.rotor_inertia, model::inertia_unit(motor.angular))},
         {"torque_constant", to_json(motor.torque_constant, force + "/(" + motor.command_unit + ")")},
         {"torque_limit", limited ? to_json(motor.torque_limit, force) : json()}});
  }
  return list;
}

json pulleys_json(const Model& model) {
  json list = json::array();
  for (const model::Pulley& pulley : model.pulleys) {
    list.push_back({{"name", pulley.name}, {"inertia", to_json(pulley.inertia, model::inertia_unit(true))}});
  }
  return list;
}

json ratios_json(const Model& model) {
  json list = json::array();
  for (const model::Ratio& ratio : model.ratios) {
    list.push_back({{"name", ratio.name}, {"of", ratio.motor}, {"to", terms_json(ratio.to)}});
  }
  return list;
}

json inertias_json(const Model& model) {
  json list = json::array();
  for (const model::Inertia& inertia : model.inertias) {
    const std::string unit = model::inertia_unit(model::is_angular(model, inertia.at));
    list.push_back({{"name", inertia.name}, {"at", inertia.at}, {"value", to_json(inertia.value, unit)}});
  }
  return list;
}

json sensors_json(const Model& model) {
  json list = json::array();
  for (const model::Sensor& sensor : model.sensors) {
    list.push_back({{"name", sensor.name},
                    {"measures", sensor.measures},
                    {"unit", model::position_unit(sensor_is_angular(model, sensor.name))},
                    {"resolution", sensor.resolution},
                    {"noise", sensor.noise},
                    {"floor", sensor.floor()}});
  }
  return list;
}

json switches_json(const Model& model) {
  json list = json::array();
  for (const model::ContactSwitch& one : model.switches) {
    list.push_back({{"name", one.name}, {"foot", model.feet[static_cast<std::size_t>(one.foot)].name}});
  }
  return list;
}

void print_drivetrain(const Model& model) {
  Rows rows;
  for (const model::Coordinate& coordinate : model.coordinates) {
    rows.push_back({coordinate.name, kind_of(coordinate.angular), sum_text(coordinate.terms)});
  }
  fmt::print("\nCoordinates:\n\n");
  print_table({"name", "kind", "sum of joints"}, rows);
  rows.clear();
  for (const model::Motor& motor : model.motors) {
    const std::string limit =
        motor.torque_limit.value > 0.0
            ? fmt::format("{:g} {}", motor.torque_limit.value, model::force_unit(motor.angular))
            : "none";
    rows.push_back({motor.name, motor.command_unit,
                    fmt::format("{:g} {}", motor.rotor_inertia.value, model::inertia_unit(motor.angular)),
                    fmt::format("{:g}", motor.torque_constant.value), limit});
  }
  fmt::print("\nMotors:\n\n");
  print_table({"name", "command", "rotor inertia", "torque constant", "limit"}, rows);
  rows.clear();
  for (const model::Pulley& pulley : model.pulleys) {
    rows.push_back({pulley.name, fmt::format("{:g} {}", pulley.inertia.value, model::inertia_unit(true))});
  }
  if (!rows.empty()) {
    fmt::print("\nPulleys:\n\n");
    print_table({"name", "inertia"}, rows);
    rows.clear();
  }
  for (const model::Ratio& ratio : model.ratios) {
    rows.push_back({ratio.name, ratio.motor + " = " + sum_text(ratio.to)});
  }
  fmt::print("\nRatios:\n\n");
  print_table({"name", "position"}, rows);
}

void print_effects(const Model& model) {
  Rows rows;
  for (const model::EffectUse& use : model.effects) {
    for (std::size_t p = 0; p < use.values.size(); ++p) {
      const Quantity& quantity = use.values[p];
      rows.push_back({use.label(), use.law->declaration().parameters[p].name,
                      fmt::format("{:g}", quantity.value),
                      quantity.uncertainty > 0.0 ? fmt::format("{:.2g}", quantity.uncertainty) : "-",
                      unit_of(model, use, p), origin_text(quantity)});
    }
  }
  fmt::print("\nEffects:\n\n");
  if (rows.empty()) {
    fmt::print("  none\n");
    return;
  }
  print_table({"effect", "parameter", "value", "+-", "unit", "source"}, rows);
}

void print_sensors(const Model& model) {
  Rows rows;
  for (const model::Sensor& sensor : model.sensors) {
    const std::string unit = model::position_unit(sensor_is_angular(model, sensor.name));
    rows.push_back({sensor.name, sensor.measures, fmt::format("{:.4g} {}", sensor.resolution, unit),
                    fmt::format("{:.3g} {}", sensor.noise, unit),
                    fmt::format("{:.3g} {}", sensor.floor(), unit)});
  }
  fmt::print("\nSensors:\n\n");
  for (const model::ContactSwitch& one : model.switches) {
    rows.push_back({one.name, "contact of " + model.feet[static_cast<std::size_t>(one.foot)].name,
                    "open/closed", "", "sample period/sqrt(12)"});
  }
  print_table({"name", "measures", "resolution", "noise", "floor"}, rows);
}

}  // namespace

Freedom freedom_of(const model::Model& model, const std::vector<validation::Lock>& locks) {
  std::vector<model::Lock> held;
  held.reserve(locks.size());
  for (const validation::Lock& lock : locks) {
    held.push_back({lock.at, lock.value});
  }
  const model::Plant plant(model, held);  // refuses contradictory ratios and singular mass matrices
  return {plant.positions(), plant.states()};
}

json to_json(const Model& model, const Freedom& freedom) {
  json places = json::object();
  for (const effects::Place place : all_places()) {
    places[effects::to_string(place)] = model.places(place);
  }
  return {{"kind", "model"},
          {"file", model.file},
          {"robot", model.robot},
          {"lineage", model.lineage},
          {"skeleton", model.skeleton.file},
          {"independent_coordinates", freedom.coordinates},
          {"states", freedom.states},
          {"bodies", bodies_json(model)},
          {"coordinates", coordinates_json(model)},
          {"motors", motors_json(model)},
          {"pulleys", pulleys_json(model)},
          {"ratios", ratios_json(model)},
          {"inertias", inertias_json(model)},
          {"effects", effects_json(model)},
          {"sensors", sensors_json(model)},
          {"contact_switches", switches_json(model)},
          {"places", places}};
}

void print(const Model& model, const Freedom& freedom) {
  fmt::print("Model {}: {}\n", model.file, model.robot);
  for (std::size_t i = 0; i + 1 < model.lineage.size(); ++i) {
    fmt::print("  stands on {}\n", model.lineage[i]);
  }
  double mass = 0.0;
  for (const model::Body& body : model.skeleton.bodies) {
    mass += body.mass;
  }
  fmt::print("  {} bodies, {:g} kg in all; {} independent coordinates, {} states\n",
             model.skeleton.bodies.size(), mass, freedom.coordinates, freedom.states);
  print_drivetrain(model);
  print_effects(model);
  print_sensors(model);
  fmt::print("\nPlaces for effects:\n\n");
  Rows rows;
  for (const effects::Place place : all_places()) {
    std::string names;
    for (const std::string& name : model.places(place)) {
      names += (names.empty() ? "" : ", ") + name;
    }
    rows.push_back({effects::to_string(place), names});
  }
  print_table({"kind", "names"}, rows);
}

}  // namespace plumbline::cli
