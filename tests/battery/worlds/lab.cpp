#include "tests/battery/worlds/lab.h"

#include <algorithm>
#include <array>

namespace plumbline::battery::worlds {
namespace {

// One standard deviation each.
constexpr double kRatio = 3e-4;      // of a drum's or pulley's radius: 10 um on 30 mm
constexpr double kCentre = 3e-4;     // m, a centre of mass balanced on an edge
constexpr double kLength = 2e-4;     // m, between two bearings
constexpr double kZeroCounts = 0.5;  // of a sensor's zero, set against a pin: half a count
constexpr double kDelay = 3e-5;      // s, from a controller's output to the amplifier's current

void add_bodies(const model::Model& model, std::vector<Unknown>& list) {
  for (const model::Body& body : model.skeleton.bodies) {
    if (body.mass <= 0.0 || body.mass_uncertainty <= 0.0) {
      continue;
    }
    const double share = body.mass_uncertainty / body.mass;
    list.push_back({"mass of " + body.name, [name = body.name, share](Rig& rig, double d) {
                      for (Link& link : rig.bodies) {
                        if (link.name == name) {
                          link.mass *= 1.0 + d * share;
                          link.central *= 1.0 + d * share;
                        }
                      }
                    }});
  }
}

void add_motors(const model::Model& model, std::vector<Unknown>& list) {
  for (const model::Motor& motor : model.motors) {
    if (motor.rotor_inertia.uncertainty > 0.0) {
      list.push_back({"rotor inertia of " + motor.name,
                      [name = motor.name, step = motor.rotor_inertia.uncertainty](Rig& rig, double d) {
                        rig.motor(name)->inertia += d * step;
                      }});
    }
    const double share = motor.torque_constant.uncertainty / motor.torque_constant.value;
    if (share > 0.0) {
      list.push_back({"torque constant of " + motor.name, [name = motor.name, share](Rig& rig, double d) {
                        rig.motor(name)->torque_per_unit *= 1.0 + d * share;
                      }});
    }
  }
}

/// The rig's effect of this name at this place; nullptr: none.
Hidden* effect_of(Rig& rig, const std::string& effect, const std::string& at) {
  for (Hidden& one : rig.effects) {
    if (one.effect == effect && one.at == at) {
      return &one;
    }
  }
  return nullptr;
}

}  // namespace

std::vector<Unknown> stated(const model::Model& model) {
  std::vector<Unknown> list;
  add_bodies(model, list);
  for (const model::EffectUse& use : model.effects) {
    const effects::Declaration& declaration = use.law->declaration();
    for (std::size_t i = 0; i < use.values.size(); ++i) {
      const double step = use.values[i].uncertainty;
      const std::string parameter = declaration.parameters[i].name;
      if (step > 0.0) {
        list.push_back({use.label() + ":" + parameter, [=](Rig& rig, double d) {
                          Hidden* one = effect_of(rig, declaration.name, use.at);
                          if (one != nullptr) {
                            one->values[parameter] += d * step;
                          }
                        }});
      }
    }
  }
  add_motors(model, list);
  return list;
}

std::vector<Unknown> unstated(const Rig& rig) {
  std::vector<Unknown> list;
  for (const Motor& motor : rig.motors) {
    list.push_back({"ratio of " + motor.name,
                    [name = motor.name](Rig& r, double d) { r.motor(name)->ratio *= 1.0 + d * kRatio; }});
    list.push_back({"delay of " + motor.name, [name = motor.name](Rig& r, double d) {
                      r.effects.push_back({"command_delay", name, {{"delay", std::abs(d) * kDelay}}});
                    }});
  }
  for (const Link& link : rig.bodies) {
    list.push_back({"centre of " + link.name + ", along",
                    [name = link.name](Rig& r, double d) { r.body(name).along += d * kCentre; }});
    list.push_back({"centre of " + link.name + ", across",
                    [name = link.name](Rig& r, double d) { r.body(name).across += d * kCentre; }});
  }
  if (rig.length > 0.0) {
    list.push_back({"length", [](Rig& r, double d) { r.length += d * kLength; }});
  }
  for (const Sensor& sensor : rig.sensors) {
    list.push_back({"zero of " + sensor.name, [name = sensor.name](Rig& r, double d) {
                      for (Sensor& one : r.sensors) {
                        one.offset += one.name == name ? d * kZeroCounts * one.resolution : 0.0;
                      }
                    }});
  }
  return list;
}

model::Model with_tolerances(const model::Model& model) {
  model::Model open = model;
  const auto state = [&](const std::string& law, const std::string& at, double deviation) {
    model::EffectUse use;
    use.law = effects::Catalogue::all().find(law);
    use.at = at;
    for (const double null : use.law->null_values()) {
      model::Quantity quantity;
      quantity.value = null;
      quantity.uncertainty = deviation;
      use.values.push_back(quantity);
    }
    open.effects.push_back(std::move(use));
  };
  for (const model::Body& body : model.skeleton.bodies) {
    if (body.mass > 0.0 && body.mass_uncertainty > 0.0) {
      state("com_shift", body.name, kCentre);
    }
  }
  for (const model::Motor& motor : model.motors) {
    state("command_delay", motor.name, kDelay);
  }
  for (const model::Sensor& sensor : model.sensors) {
    if (!sensor.shows_position()) {
      continue;
    }
    state("encoder_offset", sensor.name, kZeroCounts * sensor.resolution);
    const bool is_at_motor = std::any_of(model.motors.begin(), model.motors.end(),
                                         [&](const model::Motor& m) { return m.name == sensor.measures; });
    if (is_at_motor) {
      state("encoder_scale", sensor.name, kRatio);
    }
  }
  return open;
}

void scatter(const std::vector<Unknown>& unknowns, Draw& draw, Rig& rig) {
  for (const Unknown& unknown : unknowns) {
    unknown.move(rig, draw.deviations());
  }
}

// A ratio is a sensor's scale, a zero and a centre of mass are a preload or a tilt, a delay is nearly a lag.
bool is_of_the_lab(const std::string& effect) {
  constexpr std::array<const char*, 8> kNames{"encoder_scale", "encoder_offset", "com_shift",
                                              "gravity_tilt",  "preload",        "torque_bias",
                                              "command_delay", "actuator_lag"};
  return std::any_of(kNames.begin(), kNames.end(), [&](const char* name) { return effect == name; });
}

}  // namespace plumbline::battery::worlds
