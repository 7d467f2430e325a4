#include "simulator/model/model_sections.h"

#include <algorithm>
#include <cmath>

#include "simulator/model/from_data_sheets.h"
#include "simulator/model/kinds.h"
#include "simulator/model/quantity.h"
#include "simulator/trace/units.h"

namespace plumbline::model {
namespace {

using Sign = QuantityRule::Sign;

constexpr double kTurn = 6.283185307179586476925286766559;  // rad

Quantity one(const std::string& why) {
  Quantity quantity;
  quantity.value = 1.0;
  quantity.source = why;
  return quantity;
}

/// The first of the units that the quantity's own unit agrees with; the front one when none does.
std::string agreeing_unit(const YamlNode& quantity, const std::vector<std::string>& units) {
  const std::optional<YamlNode> unit = quantity.is_map() ? quantity.find("unit") : std::nullopt;
  if (unit) {
    for (const std::string& candidate : units) {
      if (units_agree(unit->text(), candidate)) {
        return candidate;
      }
    }
  }
  return units.front();
}

double not_zero(const YamlNode& node) {
  const double factor = node.number();
  if (factor == 0.0) {
    node.refuse("a number that is not zero");
  }
  return factor;
}

void require_known(const YamlNode& node, const std::string& name, const std::vector<std::string>& known,
                   const std::string& kind) {
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    node.refuse(quote(name), "the name of a " + kind + nearest_names(name, known));
  }
}

Coordinate read_coordinate(const std::string& name, const YamlNode& node, const Model& model) {
  check_name(name, node);
  node.allow_keys({"of", "source", "assumed"});
  Coordinate coordinate;
  coordinate.name = name;
  const YamlNode of = node.at("of");
  for (const auto& [joint, factor] : of.entries()) {
    const bool pulley = model.find_pulley(joint) != nullptr;
    if (!pulley) {
      require_known(factor, joint, joint_names(model.skeleton), "moving joint of the skeleton");
    }
    const bool angular = pulley || find_joint(model.skeleton, joint)->type == JointType::revolute;
    if (!coordinate.terms.empty() && angular != coordinate.angular) {
      factor.refuse(angular ? "a rotary joint beside linear ones" : "a linear joint beside rotary ones",
                    "joints of one kind");
    }
    coordinate.angular = angular;
    coordinate.terms.push_back({joint, not_zero(factor)});
  }
  if (coordinate.terms.empty()) {
    of.refuse("no joints", "a map {joint: factor, ...}");
  }
  if (node.has("source") || node.has("assumed")) {
    read_origin(node);
  }
  return coordinate;
}

bool commands_force(const Motor& motor) { return units_agree(motor.command_unit, force_unit(motor.angular)); }

std::string read_command_unit(const YamlNode& node, bool angular) {
  std::string unit = node.text();
  const std::vector<std::string> allowed{force_unit(angular), "A", "V"};
  const auto agrees = [&](const std::string& candidate) { return units_agree(unit, candidate); };
  if (std::none_of(allowed.begin(), allowed.end(), agrees)) {
    node.refuse("unit " + quote(unit), "a unit like " + force_unit(angular) + ", A or V");
  }
  return unit;
}

/// Torque per command unit. A motor whose command is a torque may still state its constant per ampere or
/// volt.
void read_torque_constant(const YamlNode& node, Motor& motor) {
  const std::optional<YamlNode> given = node.find("torque_constant");
  if (const auto winding = node.find("winding")) {
    if (given) {
      given->refuse("a torque constant beside a winding", "one of them: a winding has its own");
    }
    read_winding(*winding, motor);
    return;
  }
  if (!given && commands_force(motor)) {
    motor.torque_constant = one("the command is a torque or force");
    return;
  }
  const std::string force = force_unit(motor.angular);
  std::vector<std::string> units{force + "/" + (units_agree(motor.command_unit, "V") ? "V" : "A")};
  if (commands_force(motor)) {
    units = {force + "/A", force + "/V", "1"};
  }
  const YamlNode constant = node.at("torque_constant");
  motor.torque_constant =
      read_quantity(constant, {agreeing_unit(constant, units), Sign::positive, false, {"factory"}});
  if (const auto factory = constant.find("factory")) {
    motor.factory_torque_constant = motor.torque_constant;
    motor.factory_torque_constant.value = factory->number() * to_si_factor(motor.torque_constant.unit);
    motor.factory_torque_constant.uncertainty = 0.0;
    motor.factory_torque_constant.line = factory->line();
    if (!(motor.factory_torque_constant.value > 0.0)) {
      factory->refuse("a number above zero");
    }
  }
}

Motor read_motor(const std::string& name, const YamlNode& node) {
  check_name(name, node);
  node.allow_keys({"command_unit", "rotor_inertia", "torque_constant", "winding", "torque_limit"});
  Motor motor;
  motor.name = name;
  const YamlNode inertia = node.at("rotor_inertia");
  const std::string unit = agreeing_unit(inertia, {"kg m^2", "kg"});
  motor.angular = unit != "kg";
  motor.rotor_inertia = read_quantity(inertia, {unit, Sign::positive, false, {}});
  motor.command_unit = read_command_unit(node.at("command_unit"), motor.angular);
  read_torque_constant(node, motor);
  if (const auto limit = node.find("torque_limit")) {
    motor.torque_limit = read_quantity(*limit, {force_unit(motor.angular), Sign::positive, false, {}});
  }
  return motor;
}

void add_term(const std::string& coordinate, const YamlNode& quantity, const Model& model, Ratio& ratio) {
  require_known(quantity, coordinate, coordinate_names(model), "coordinate");
  const std::string unit = ratio_unit(is_angular(model, ratio.motor), is_angular(model, coordinate));
  ratio.ratios.push_back(read_quantity(quantity, {unit, Sign::not_zero, false, {}}));
  const auto same = [&](const Term& term) { return term.of == coordinate; };
  if (std::any_of(ratio.to.begin(), ratio.to.end(), same)) {
    quantity.refuse("this coordinate twice", "each coordinate once in a ratio");
  }
  ratio.to.push_back({coordinate, ratio.ratios.back().value});
}

/// A joint or pulley that is tied to coordinates.
Ratio read_tie(const std::string& name, const YamlNode& node, const Model& model) {
  const bool pulley = node.has("pulley");
  const char* key = pulley ? "pulley" : "joint";
  node.allow_keys({key, "of"});
  Ratio ratio;
  ratio.name = name;
  ratio.motor = node.at(key).text();
  require_known(node.at(key), ratio.motor, pulley ? pulley_names(model) : joint_names(model.skeleton),
                pulley ? "pulley" : "moving joint of the skeleton");
  for (const auto& [coordinate, quantity] : node.at("of").entries()) {
    add_term(coordinate, quantity, model, ratio);
  }
  if (ratio.to.empty()) {
    node.at("of").refuse("no coordinates", "a map {coordinate: {value: ..., unit: ..., source: ...}}");
  }
  return ratio;
}

Ratio read_motor_ratio(const std::string& name, const YamlNode& node, const Model& model) {
  node.allow_keys({"motor", "ratio", "also", "joint", "pulley", "of"});
  require_known(node, name, coordinate_names(model), "coordinate");
  Ratio ratio;
  ratio.name = name;
  ratio.motor = node.at("motor").text();
  require_known(node.at("motor"), ratio.motor, motor_names(model), "motor");
  add_term(name, node.at("ratio"), model, ratio);
  if (const auto also = node.find("also")) {
    for (const auto& [coordinate, quantity] : also->entries()) {
      add_term(coordinate, quantity, model, ratio);
    }
  }
  for (const char* key : {"joint", "pulley", "of"}) {
    if (const auto misplaced = node.find(key)) {
      misplaced->refuse("this key beside `motor`", "either motor and ratio, or joint (or pulley) and of");
    }
  }
  return ratio;
}

double read_resolution(const YamlNode& node, const std::string& unit, bool counts_turns,
                       std::string& source) {
  const auto step = node.find("resolution");
  const auto counts = node.find("counts_per_turn");
  if (step && counts) {
    counts->refuse("both resolution and counts_per_turn", "one of them");
  }
  if (step) {
    const Quantity resolution = read_quantity(*step, {unit, Sign::not_negative, false, {}});
    source = resolution.source;
    return resolution.value;
  }
  const auto gear = node.find("gear");
  if (!counts) {
    return gear ? (gear->refuse("a gear without counts_per_turn", "both"), 0.0) : 0.0;
  }
  if (!counts_turns) {
    counts->refuse("counts per turn where none are counted",
                   "resolution: {value: ..., unit: " + unit + ", source: ...}");
  }
  const double per_turn = counts->number();
  const double turns = gear ? gear->number() : 1.0;
  if (!(per_turn > 0.0)) {
    counts->refuse("a number above zero");
  }
  if (!(turns > 0.0)) {
    gear->refuse("a number above zero: turns of the sensor for one turn of what it measures");
  }
  const double resolution = kTurn / (per_turn * turns);
  if (!std::isfinite(resolution)) {
    counts->refuse("a credible number of counts");
  }
  return resolution;
}

void read_noise(const YamlNode& node, const std::string& unit, Sensor& sensor) {
  if (const auto noise = node.find("noise")) {
    sensor.noise = read_quantity(*noise, {unit, Sign::not_negative, false, {}}).value;
  }
}

Sensor read_sensor(const std::string& name, const YamlNode& node, const Model& model) {
  check_name(name, node);
  node.allow_keys(
      {"measures", "rate", "counts_per_turn", "gear", "resolution", "offset", "noise", "source", "assumed"});
  Sensor sensor;
  sensor.name = name;
  sensor.measures = node.at("measures").text();
  std::vector<std::string> measurable = position_names(model);
  for (const std::string& joint : joint_names(model.skeleton)) {
    if (model.find_coordinate(joint) == nullptr) {
      measurable.push_back(joint);
    }
  }
  require_known(node.at("measures"), sensor.measures, measurable, "coordinate, motor, pulley or joint");
  const bool angular = is_angular(model, sensor.measures);
  const auto rate = node.find("rate");
  sensor.rate = rate && rate->flag();
  const std::string unit = position_unit(angular) + (sensor.rate ? "/s" : "");
  sensor.resolution = read_resolution(node, unit, angular && !sensor.rate, sensor.source);
  if (const auto offset = node.find("offset")) {
    sensor.offset = read_quantity(*offset, {unit, Sign::any, false, {}}).value;
  }
  read_noise(node, unit, sensor);
  if (sensor.rate && sensor.floor() == 0.0) {
    node.refuse("neither resolution nor noise above zero",
                "one of them: together they are the sensor's floor");
  }
  if (node.has("source") || node.has("assumed") || !node.has("resolution")) {
    sensor.source = read_origin(node).text;
  }
  return sensor;
}

int foot_of(const YamlNode& node, const Model& model) {
  std::vector<std::string> names;
  for (const Foot& foot : model.feet) {
    names.push_back(foot.name);
  }
  require_known(node, node.text(), names, "foot of the model");
  const auto is_it = [&](const Foot& one) { return one.name == node.text(); };
  return static_cast<int>(std::find_if(model.feet.begin(), model.feet.end(), is_it) - model.feet.begin());
}

Sensor read_force_plate(const std::string& name, const YamlNode& node, const Model& model) {
  check_name(name, node);
  node.allow_keys({"force", "resolution", "noise", "source", "assumed"});
  Sensor sensor;
  sensor.name = name;
  for (const YamlNode& item : node.at("force").items()) {
    sensor.feet.push_back(foot_of(item, model));
  }
  if (sensor.feet.empty()) {
    node.at("force").refuse("no feet", "the feet that stand on the plate, [toe]");
  }
  sensor.resolution =
      read_quantity(node.at("resolution"), {force_unit(false), Sign::positive, false, {}}).value;
  read_noise(node, force_unit(false), sensor);
  sensor.source = read_origin(node).text;
  return sensor;
}

ContactSwitch read_switch(const std::string& name, const YamlNode& node, const Model& model) {
  check_name(name, node);
  node.allow_keys({"contact", "threshold", "closes_late", "opens_late", "lateness_uncertainty", "bounce",
                   "source", "assumed"});
  ContactSwitch contact{name, foot_of(node.at("contact"), model), read_origin(node).text};
  const auto read = [&](const char* key, const char* unit, double& value) {
    if (const auto given = node.find(key)) {
      value = read_quantity(*given, {unit, Sign::not_negative, false, {}}).value;
    }
  };
  read("threshold", "N", contact.threshold);
  read("closes_late", "s", contact.closes_late);
  read("opens_late", "s", contact.opens_late);
  read("lateness_uncertainty", "s", contact.lateness_uncertainty);
  read("bounce", "s", contact.bounce);
  return contact;
}

}  // namespace

void read_gravity(const YamlNode& node, Model& model) {
  const Quantity gravity = read_quantity(node, {"m/s^2", Sign::not_negative, false, {}});
  const double given = model.skeleton.gravity.norm();
  const Eigen::Vector3d direction =
      given > 0.0 ? Eigen::Vector3d(model.skeleton.gravity / given) : Eigen::Vector3d(0.0, 0.0, -1.0);
  model.skeleton.gravity = gravity.value * direction;
}

void read_masses(const YamlNode& node, Model& model) {
  for (const auto& [name, entry] : node.entries()) {
    require_known(entry, name, model.places(effects::Place::body), "link of the skeleton");
    entry.allow_keys({"uncertainty", "source", "assumed"});
    read_origin(entry);
    Body& body = model.skeleton.bodies[static_cast<std::size_t>(model.body_index(name))];
    body.mass_uncertainty = read_uncertainty(entry.at("uncertainty"), body.mass, 1.0);
  }
}

void read_coordinates(const YamlNode& node, Model& model) {
  for (const auto& [name, entry] : node.entries()) {
    model.coordinates.push_back(read_coordinate(name, entry, model));
  }
}

void read_motors(const YamlNode& node, Model& model) {
  for (const auto& [name, entry] : node.entries()) {
    model.motors.push_back(read_motor(name, entry));
  }
}

void read_pulleys(const YamlNode& node, Model& model) {
  for (const auto& [name, entry] : node.entries()) {
    check_name(name, entry);
    entry.allow_keys({"inertia"});
    model.pulleys.push_back(
        {name, read_quantity(entry.at("inertia"), {inertia_unit(true), Sign::positive, false, {}})});
  }
}

void read_ratios(const YamlNode& node, Model& model) {
  for (const auto& [name, entry] : node.entries()) {
    check_name(name, entry);
    const bool tie = (entry.has("joint") || entry.has("pulley")) && !entry.has("motor");
    model.ratios.push_back(tie ? read_tie(name, entry, model) : read_motor_ratio(name, entry, model));
  }
}

void read_inertias(const YamlNode& node, Model& model) {
  for (const auto& [name, entry] : node.entries()) {
    check_name(name, entry);
    entry.allow_keys({"at", "value"});
    Inertia inertia;
    inertia.name = name;
    inertia.at = entry.at("at").text();
    require_known(entry.at("at"), inertia.at, position_names(model), "coordinate or motor");
    inertia.value = read_quantity(entry.at("value"),
                                  {inertia_unit(is_angular(model, inertia.at)), Sign::positive, false, {}});
    model.inertias.push_back(std::move(inertia));
  }
}

void read_sensors(const YamlNode& node, Model& model) {
  for (const auto& [name, entry] : node.entries()) {
    if (entry.is_map() && entry.has("contact")) {
      model.switches.push_back(read_switch(name, entry, model));
    } else if (entry.is_map() && entry.has("force")) {
      model.sensors.push_back(read_force_plate(name, entry, model));
    } else if (is_point_sensor(entry)) {
      read_point_sensor(name, entry, model);
    } else {
      model.sensors.push_back(read_sensor(name, entry, model));
    }
  }
}

}  // namespace plumbline::model
