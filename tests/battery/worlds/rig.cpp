#include "tests/battery/worlds/rig.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/battery/worlds/equations.h"
#include "tests/battery/worlds/mabel.h"

namespace plumbline::battery::worlds {
namespace {

Vector row(std::initializer_list<double> factors) {
  Vector v(static_cast<Eigen::Index>(factors.size()));
  std::copy(factors.begin(), factors.end(), v.data());
  return v;
}

void add_sensors(const model::Model& model, Rig& rig) {
  for (const model::Sensor& one : model.sensors) {
    Sensor sensor{one.name, "", {}, one.resolution, one.noise};
    if (rig.motor(one.measures) != nullptr) {
      sensor.motor = one.measures;
    } else {
      const Place* place = rig.place(one.measures);
      if (place == nullptr) {
        throw std::invalid_argument("no foreign world measures " + one.measures);
      }
      sensor.row = place->row;
    }
    rig.sensors.push_back(sensor);
  }
}

void add_effects(const model::Model& model, Rig& rig) {
  for (const model::EffectUse& use : model.effects) {
    Hidden hidden{use.law->declaration().name, use.at, {}};
    for (std::size_t i = 0; i < use.values.size(); ++i) {
      hidden.values[use.law->declaration().parameters[i].name] = use.values[i].value;
    }
    hide(hidden, rig);
  }
}

Rig pendulum(const model::Model& model) {
  Rig rig;
  rig.coordinates = 1;
  rig.equations = pendulum_equations;
  rig.bodies = {link_of(model, "arm")};
  rig.motors = {motor_of(model, "drive", 0)};
  rig.places = {{"shoulder", row({1.0})}};
  return rig;
}

Rig leg_bench(const model::Model& model) {
  Rig rig;
  rig.coordinates = 2;
  rig.equations = leg_bench_equations;
  for (const char* body : {"thigh", "shin", "cspring", "cshin"}) {
    rig.bodies.push_back(link_of(model, body));
  }
  rig.length = 0.5;
  for (const model::Joint& joint : model.skeleton.joints) {
    if (joint.name == "knee") {
      rig.length = -joint.X_PJ.translation().z();
    }
  }
  rig.motors = {motor_of(model, "mLA", 0), motor_of(model, "mLS", 1)};
  rig.places = {{"leg_angle", row({1.0, 0.0})},
                {"leg_shape", row({0.0, 1.0})},
                {"thigh", row({1.0, 1.0})},
                {"shin", row({1.0, -1.0})},
                {"knee", row({0.0, -2.0})}};
  return rig;
}

Rig hopper(const model::Model& model) {
  Rig rig;
  rig.coordinates = 3;
  rig.equations = hopper_equations;
  for (const char* body : {"body", "slider", "foot"}) {
    rig.bodies.push_back(link_of(model, body));
  }
  rig.motors = {motor_of(model, "drive", 1)};
  rig.places = {
      {"height", row({1.0, 0.0, 0.0})}, {"carriage", row({0.0, 1.0, 0.0})}, {"spring", row({0.0, 0.0, 1.0})}};
  Ground ground;
  ground.name = model.feet.front().name;
  ground.row = row({1.0, -1.0, 1.0});
  ground.constant = model.feet.front().point.z();
  rig.grounds = {ground};
  for (const model::ContactSwitch& one : model.switches) {
    rig.switches.push_back(one.name);
    rig.switch_force = one.threshold;
  }
  return rig;
}

Rig cart(const model::Model& model) {
  Rig rig;
  rig.coordinates = 1;
  rig.equations = cart_equations;
  rig.bodies = {link_of(model, "cart")};
  const Eigen::Vector3d axis = model.skeleton.joints.front().axis;
  rig.incline = std::atan2(axis.z(), axis.x());
  rig.motors = {motor_of(model, "belt", 0)};
  rig.places = {{"cart", row({1.0})}};
  return rig;
}

/// Changes of numbers; false where the effect is none.
bool change_motor(const Hidden& e, Motor& motor) {
  if (e.effect == "torque_constant_error") {
    motor.torque_per_unit *= e["scale"];
    return true;
  }
  if (e.effect == "rotor_inertia") {
    motor.inertia += e["inertia"];
    return true;
  }
  return false;
}

bool change_body(const Hidden& e, Link& link) {
  if (e.effect == "added_mass") {
    link.central *= 1.0 + e["mass"] / link.mass;
    link.mass += e["mass"];
    return true;
  }
  if (e.effect == "com_shift") {
    link.across += e["x"];
    link.along -= e["z"];
    return true;
  }
  if (e.effect == "payload") {  // a point mass: about the pivot its m (x^2 + z^2) is added to the link's
    const double pivot = link.about_pivot() + e["mass"] * (e["x"] * e["x"] + e["z"] * e["z"]);
    const double whole = link.mass + e["mass"];
    link.across = (link.mass * link.across + e["mass"] * e["x"]) / whole;
    link.along = (link.mass * link.along - e["mass"] * e["z"]) / whole;
    link.mass = whole;
    link.central = pivot - whole * (link.along * link.along + link.across * link.across);
    return true;
  }
  return false;
}

bool change_ground(const Hidden& e, Ground& ground) {
  if (e.effect == "ground_normal") {
    ground.stiffness = e["stiffness"];
    ground.damping = e["damping"];
    ground.root_damping = e["root_damping"];
    ground.rounding = e["rounding"];
    ground.exponent = e["exponent"];
    return true;
  }
  if (e.effect == "ground_friction") {
    ground.bristle_stiffness = e["bristle_stiffness"];
    ground.bristle_damping = e["bristle_damping"];
    ground.friction = e["friction"];
    ground.viscous = e["viscous"];
    ground.relaxation = e["relaxation"];
    return true;
  }
  if (e.effect == "ground_stiffness_error") {
    ground.stiffness *= e["scale"];
    return true;
  }
  if (e.effect == "ground_damping_error") {
    ground.damping *= e["scale"];
    ground.root_damping *= e["scale"];
    return true;
  }
  if (e.effect == "ground_friction_error") {  // the bristles slide at the same deflection
    ground.bristle_stiffness *= e["scale"];
    ground.friction *= e["scale"];
    ground.viscous *= e["scale"];
    return true;
  }
  if (e.effect == "ground_height_error") {
    ground.height += e["height"];
    return true;
  }
  return false;
}

bool change_sensor(const Hidden& e, Sensor& sensor) {
  if (e.effect == "encoder_offset") {
    sensor.offset += e["offset"];
    return true;
  }
  if (e.effect == "encoder_eccentricity") {
    sensor.waves = e["waves"];
    sensor.amplitude = std::hypot(e["sine"], e["cosine"]);
    sensor.phase = std::atan2(e["sine"], e["cosine"]);
    return true;
  }
  if (e.effect == "sensor_lag") {
    sensor.late += e["lag"];
    return true;
  }
  if (e.effect == "lost_counts") {
    sensor.lost_share += e["share"];
    sensor.limit_speed = e["limit_speed"];
    return true;
  }
  if (e.effect == "encoder_scale") {
    sensor.scale *= e["scale"];
    return true;
  }
  if (e.effect == "held_reading") {
    sensor.held_share += e["share"];
    return true;
  }
  if (e.effect == "heavy_bit") {
    sensor.bit_error = e["error"];
    sensor.bit_step = e["step"];
    return true;
  }
  return false;
}

bool change_numbers(const Hidden& e, Rig& rig) {
  if (e.effect == "gravity_tilt") {
    rig.tilt += e["pitch"];
    return true;
  }
  for (Motor& motor : rig.motors) {
    if (motor.name == e.at && change_motor(e, motor)) return true;
  }
  for (Link& link : rig.bodies) {
    if (link.name == e.at && change_body(e, link)) return true;
  }
  for (Sensor& sensor : rig.sensors) {
    if (sensor.name == e.at && change_sensor(e, sensor)) return true;
  }
  for (Ground& ground : rig.grounds) {
    if (ground.name == e.at && change_ground(e, ground)) return true;
  }
  return false;
}

}  // namespace

Link link_of(const model::Model& model, const std::string& name) {
  const model::Body& body = model.skeleton.bodies[static_cast<std::size_t>(model.body_index(name))];
  return {name, body.mass, -body.com.z(), body.com.x(), body.inertia(1, 1)};
}

Motor motor_of(const model::Model& model, const std::string& name, int drives) {
  const model::Motor& motor = *model.find_motor(name);
  Motor result{name, drives, 1.0, motor.rotor_inertia.value, motor.torque_constant.value};
  if (motor.command_unit == "N m" || motor.command_unit == "N") {
    result.torque_per_unit = 1.0;
  }
  for (const model::Ratio& ratio : model.ratios) {
    if (ratio.motor == name) {
      result.ratio = ratio.ratios.front().value;
    }
  }
  for (const model::Inertia& inertia : model.inertias) {
    result.inertia += inertia.at == name ? inertia.value.value : 0.0;
  }
  return result;
}

Link& Rig::body(const std::string& name) {
  for (Link& link : bodies) {
    if (link.name == name) return link;
  }
  throw std::invalid_argument("no body " + name);
}

Motor* Rig::motor(const std::string& name) {
  for (Motor& one : motors) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

const Place* Rig::place(const std::string& name) const {
  for (const Place& one : places) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

bool has_rig(const std::string& robot) {
  return robot == "pendulum" || robot == "leg_bench" || robot == "hopper" || robot == "cart" ||
         robot == "mabel";
}

Rig rig_of(const std::string& robot, const model::Model& model) {
  if (!has_rig(robot)) {
    throw std::invalid_argument("no foreign world has the robot " + robot);
  }
  Rig rig = robot == "pendulum"    ? pendulum(model)
            : robot == "leg_bench" ? leg_bench(model)
            : robot == "cart"      ? cart(model)
            : robot == "mabel"     ? mabel(model)
                                   : hopper(model);
  rig.gravity = model.skeleton.gravity.norm();
  add_sensors(model, rig);
  add_effects(model, rig);
  return rig;
}

void hide(const Hidden& effect, Rig& rig) {
  if (change_numbers(effect, rig)) {
    return;
  }
  const bool is_anywhere = effect.at == "world";
  if (!is_anywhere && rig.motor(effect.at) == nullptr && rig.place(effect.at) == nullptr) {
    throw std::invalid_argument("the rig has no place " + effect.at + " for " + effect.effect);
  }
  rig.effects.push_back(effect);
}

}  // namespace plumbline::battery::worlds
