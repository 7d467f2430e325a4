#include <fmt/core.h>

#include "simulator/model/from_data_sheets.h"
#include "simulator/model/kinds.h"
#include "validation/cli/describe.h"
#include "validation/cli/files.h"
#include "validation/cli/output.h"
#include "validation/report/model_json.h"

namespace plumbline::cli {
namespace {

using model::Model;
using model::Quantity;
using Rows = std::vector<std::vector<std::string>>;

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

/// Of a link, by its index; of the world.
std::string link_name(const Model& model, int body) {
  return body < 0 ? "world" : model.skeleton.bodies[static_cast<std::size_t>(body)].name;
}

/// "sphere of ball", "box of tray"
void print_contacts(const Model& model) {
  Rows rows;
  const auto shape = [&](const model::ContactEnd& end) {
    return contact::name_of(end.shape) + " of " + link_name(model, end.body);
  };
  for (const model::LinkContact& contact : model.contacts) {
    rows.push_back({contact.name, shape(contact.ends[0]), shape(contact.ends[1])});
  }
  if (!rows.empty()) {
    fmt::print("\nContacts between links:\n\n");
    print_table({"name", "between", "and"}, rows);
  }
}

/// "connect", "coupler", "rocker"
void print_loops(const Model& model) {
  Rows rows;
  const auto name = [&](const model::LoopEnd& end) { return link_name(model, end.body); };
  for (const model::Loop& loop : model.loops) {
    rows.push_back({loop.name, model::to_string(loop.type), name(loop.ends[0]), name(loop.ends[1])});
  }
  if (!rows.empty()) {
    fmt::print("\nClosed loops:\n\n");
    print_table({"name", "type", "between", "and"}, rows);
  }
}

void print_effects(const Model& model) {
  Rows rows;
  for (const model::EffectUse& use : model.effects) {
    for (std::size_t p = 0; p < use.values.size(); ++p) {
      const Quantity& quantity = use.values[p];
      rows.push_back({use.label(), use.law->declaration().parameters[p].name,
                      fmt::format("{:g}", quantity.value),
                      quantity.uncertainty > 0.0 ? fmt::format("{:.2g}", quantity.uncertainty) : "-",
                      validation::unit_of(model, use, p), origin_text(quantity)});
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
    const std::string unit = model::reading_unit(model, sensor.name);
    rows.push_back(
        {sensor.name, model::measured_by(model, sensor), fmt::format("{:.4g} {}", sensor.resolution, unit),
         fmt::format("{:.3g} {}", sensor.noise, unit), fmt::format("{:.3g} {}", sensor.floor(), unit)});
  }
  fmt::print("\nSensors:\n\n");
  for (const model::ContactSwitch& one : model.switches) {
    rows.push_back({one.name, "contact of " + model.feet[static_cast<std::size_t>(one.foot)].name,
                    "open/closed", "", "sample period/sqrt(12)"});
  }
  print_table({"name", "measures", "resolution", "noise", "floor"}, rows);
}

}  // namespace

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
  print_contacts(model);
  print_loops(model);
  print_effects(model);
  print_sensors(model);
  fmt::print("\nPlaces for effects:\n\n");
  Rows rows;
  for (const effects::Place place : validation::all_places()) {
    std::string names;
    for (const std::string& name : model.places(place)) {
      names += (names.empty() ? "" : ", ") + name;
    }
    rows.push_back({effects::to_string(place), names});
  }
  print_table({"kind", "names"}, rows);
  for (const std::string& left : model.skeleton.left_out) {
    fmt::print("Not taken over from the skeleton: {}\n", left);
  }
  for (const std::string& left : model::joint_dynamics_left(model)) {
    fmt::print("{}\n", left);
  }
}

}  // namespace plumbline::cli
