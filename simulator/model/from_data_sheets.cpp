#include "simulator/model/from_data_sheets.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "simulator/model/kinds.h"
#include "simulator/model/quantity.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"

namespace plumbline::model {
namespace {

using Sign = QuantityRule::Sign;

struct Winding {
  Quantity resistance, torque_constant, back_emf;
  std::optional<Quantity> inductance;
};

double share(const Quantity& quantity) { return quantity.uncertainty / quantity.value; }

Winding winding_of(const YamlNode& node, bool angular) {
  node.allow_keys({"resistance", "torque_constant", "back_emf", "inductance"});
  Winding winding;
  winding.resistance = read_quantity(node.at("resistance"), {"ohm", Sign::positive, false, {}});
  winding.torque_constant =
      read_quantity(node.at("torque_constant"), {force_unit(angular) + "/A", Sign::positive, false, {}});
  winding.back_emf = winding.torque_constant;  // the same number in SI
  if (const auto given = node.find("back_emf")) {
    winding.back_emf =
        read_quantity(*given, {"V s/" + position_unit(angular), Sign::not_negative, false, {}});
    // One number in SI: what the current gives in torque, the motion gives in voltage (power in, power out).
    // Data sheets differ by up to sqrt(3) in what they call a phase's voltage and current, and by losses.
    constexpr double kMostApart = 2.0;
    const double k = winding.torque_constant.value;
    const double ke = winding.back_emf.value;
    if (ke > 0.0 && (k > kMostApart * ke || ke > kMostApart * k)) {
      given->refuse("a back EMF of " + number_text(ke, 4) + " V s/" + position_unit(angular) +
                        " that contradicts the torque constant of " + number_text(k, 4) + " " +
                        force_unit(angular) + "/A",
                    "about the same number in SI, from half to twice (is one of them per 1000 rpm?)");
    }
  }
  if (const auto given = node.find("inductance")) {
    winding.inductance = read_quantity(*given, {"H", Sign::positive, false, {}});
  }
  return winding;
}

/// An effect with all values at the law's usual ones, and these set.
EffectUse effect_of(const Model& model, const effects::Catalogue& catalogue, const std::string& name,
                    const std::string& at) {
  EffectUse use;
  use.law = catalogue.find(name);
  use.at = at;
  const std::vector<effects::Values> starts = use.law->starts(effects::Scales{});
  for (int i = 0; i < use.law->parameter_count(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    Quantity quantity;
    const bool usual = use.law->declaration().parameters[index].structural && !starts.empty();
    quantity.value = usual ? starts.front()[index] : use.law->declaration().parameters[index].null_value;
    const bool angular = is_angular(model, at);
    quantity.unit = effects::unit_at(use.law->declaration().parameters[index].unit, angular);
    quantity.source = "the law's usual value";
    quantity.assumed = true;
    use.values.push_back(std::move(quantity));
  }
  return use;
}

void set(EffectUse& use, const char* parameter, double value, double uncertainty, const std::string& source) {
  Quantity& quantity = use.values[static_cast<std::size_t>(use.law->parameter_index(parameter))];
  quantity.value = value;
  quantity.uncertainty = uncertainty;
  quantity.source = source;
  quantity.assumed = false;
}

/// The coordinate that is this joint alone, turned over or not.
const Coordinate* coordinate_of(const Model& model, const std::string& joint) {
  const auto found =
      std::find_if(model.coordinates.begin(), model.coordinates.end(), [&](const Coordinate& one) {
        return one.terms.size() == 1 && one.terms.front().of == joint &&
               std::abs(one.terms.front().factor) == 1.0;
      });
  return found == model.coordinates.end() ? nullptr : &*found;
}

bool has_dynamics(const Joint& joint) {
  return joint.damping > 0.0 || joint.friction > 0.0 || joint.armature > 0.0 || joint.stiffness > 0.0;
}

}  // namespace

void read_winding(const YamlNode& node, Motor& motor) {
  if (!units_agree(motor.command_unit, "V")) {
    node.refuse("a winding of a motor whose command is in " + quote(motor.command_unit), "command_unit: V");
  }
  const Winding winding = winding_of(node, motor.angular);
  const Quantity& k = winding.torque_constant;
  const Quantity& R = winding.resistance;
  motor.torque_constant.value = k.value / R.value;
  motor.torque_constant.uncertainty = motor.torque_constant.value * std::hypot(share(k), share(R));
  motor.torque_constant.unit = force_unit(motor.angular) + "/V";
  motor.torque_constant.source = "torque constant (" + k.source + ") by resistance (" + R.source + ")";
  motor.torque_constant.assumed = k.assumed || R.assumed;
  motor.torque_constant.line = node.line();
}

void add_back_emf(const YamlNode& motors, const effects::Catalogue& catalogue, Model& model) {
  for (const auto& [name, entry] : motors.entries()) {
    const auto node = entry.find("winding");
    if (!node) {
      continue;
    }
    const Winding winding = winding_of(*node, model.find_motor(name)->angular);
    const double damping = winding.torque_constant.value * winding.back_emf.value / winding.resistance.value;
    if (!(damping > 0.0) && !winding.inductance) {
      continue;
    }
    const bool delays = winding.inductance.has_value();
    EffectUse use = effect_of(model, catalogue, delays ? "winding" : "viscous", name);
    use.line = node->line();
    const double shares =
        std::hypot(share(winding.torque_constant), share(winding.back_emf), share(winding.resistance));
    set(use, delays ? "slope" : "damping", damping, damping > 0.0 ? damping * shares : 0.0,
        "back EMF of the winding: " + winding.back_emf.source + "; " + winding.resistance.source);
    if (delays) {
      const double time_constant = winding.inductance->value / winding.resistance.value;
      set(use, "time_constant", time_constant,
          time_constant * std::hypot(share(*winding.inductance), share(winding.resistance)),
          "inductance by resistance: " + winding.inductance->source + "; " + winding.resistance.source);
    }
    for (const EffectUse& other : model.effects) {
      if (!delays && other.at == name && other.law->declaration().name == "viscous") {
        node->refuse("a winding at motor " + name + ", which has the effect viscous, too",
                     "the friction of its bearings at the coordinate, or no winding: the back EMF is viscous "
                     "friction");
      }
    }
    model.effects.push_back(std::move(use));
  }
}

void take_joint_dynamics(const YamlNode& node, const effects::Catalogue& catalogue, Model& model) {
  const std::string wish = node.text();
  if (wish != "take" && wish != "leave") {
    node.refuse("take or leave" + nearest_names(wish, {"take", "leave"}));
  }
  if (wish == "leave") {
    return;
  }
  const std::string source = model.skeleton.file + ", dynamics of the joint";
  for (Joint& joint : model.skeleton.joints) {
    if (!has_dynamics(joint)) {
      continue;
    }
    const Coordinate* coordinate = coordinate_of(model, joint.name);
    if (coordinate == nullptr) {
      node.refuse(
          "take, with damping or friction of joint " + joint.name + ", which no coordinate alone stands for",
          "a coordinate {of: {" + joint.name + ": 1}}, or joint_dynamics: leave");
    }
    if (joint.damping > 0.0) {
      EffectUse use = effect_of(model, catalogue, "viscous", coordinate->name);
      set(use, "damping", joint.damping, 0.0, source);
      model.effects.push_back(std::move(use));
    }
    if (joint.friction > 0.0) {
      EffectUse use = effect_of(model, catalogue, "coulomb", coordinate->name);
      set(use, "level", joint.friction, 0.0, source);
      model.effects.push_back(std::move(use));
    }
    if (joint.stiffness > 0.0) {
      EffectUse use = effect_of(model, catalogue, "spring", coordinate->name);
      const double factor = coordinate->terms.front().factor;  // 1 or -1
      set(use, "stiffness", joint.stiffness, 0.0, source);
      set(use, "rest", factor * joint.rest, 0.0, source);
      model.effects.push_back(std::move(use));
    }
    if (joint.armature > 0.0) {
      Inertia inertia;
      inertia.name = "armature_" + joint.name;
      inertia.at = coordinate->name;
      inertia.value.value = joint.armature;
      inertia.value.unit = inertia_unit(coordinate->angular);
      inertia.value.source = source;
      model.inertias.push_back(std::move(inertia));
    }
    joint.damping = joint.friction = joint.armature = joint.stiffness = 0.0;
  }
}

std::vector<std::string> joint_dynamics_left(const Model& model) {
  std::vector<std::string> left;
  for (const Joint& joint : model.skeleton.joints) {
    if (!has_dynamics(joint) || joint.type == JointType::fixed) {
      continue;
    }
    const bool angular = joint.type == JointType::revolute;
    std::string what;
    const auto add = [&](const char* name, double value, const std::string& unit) {
      if (value > 0.0) {
        what += (what.empty() ? "" : ", ") + std::string(name) + " " + number_text(value, 4) + " " + unit;
      }
    };
    add("damping", joint.damping, force_unit(angular) + " s/" + position_unit(angular));
    add("friction", joint.friction, force_unit(angular));
    add("armature", joint.armature, inertia_unit(angular));
    add("stiffness", joint.stiffness, force_unit(angular) + "/" + position_unit(angular));
    left.push_back("The skeleton states " + what + " of joint " + joint.name +
                   ": not taken over; `joint_dynamics: take` in the model makes effects of it.");
  }
  return left;
}

}  // namespace plumbline::model
