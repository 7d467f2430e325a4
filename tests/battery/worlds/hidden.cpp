#include "tests/battery/worlds/hidden.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "tests/battery/worlds/outside.h"

namespace plumbline::battery::worlds {
namespace {

constexpr double kSharper = 3.0;  // friction turns so many times as fast as what the case states

double sign_of(const Hidden& e, double v) { return std::tanh(v * kSharper / e["smoothing_speed"]); }

/// Friction of steady sliding: Armstrong-Helouvry, Dupont and Canudas de Wit (1994), with its exponent.
double sliding(const Hidden& e, double v) {
  const auto exponent = e.values.find("stribeck_exponent");
  const double power = exponent == e.values.end() ? 2.0 : exponent->second;
  return e["level"] + e["rise"] * std::exp(-std::pow(std::abs(v) / e["stribeck_speed"], power));
}

/// A stop takes up force behind its position only, and never pulls, but where a paper's does (MABEL's).
double stop_force(const Hidden& e, const PlaceMotion& m) {
  const double deep = e["side"] * (m.x - e["position"]);
  if (deep <= 0.0) {
    return 0.0;
  }
  const double in = e["side"] * m.v;
  const double rounding = e["rounding"];
  const double root = in > 0.0 ? std::sqrt(in + rounding) - std::sqrt(rounding) : 0.0;
  const double push = e["stiffness"] * deep + e["cubic_stiffness"] * deep * deep * deep + e["damping"] * in +
                      e["root_damping"] * root;
  return push < 0.0 && e["pulls"] == 0.0 ? 0.0 : -e["side"] * push;
}

double one_sided_spring(const Hidden& e, const PlaceMotion& m) {
  const double deep = e["side"] * (m.x - e["rest"]);
  return deep <= 0.0
             ? 0.0
             : -e["side"] * (e["stiffness"] * deep + e["preload"] * std::tanh(deep / e["smoothing_length"]));
}

struct Named {
  const char* name;
  Law law;
};

constexpr std::array<Named, 27> kForces{{
    {"viscous", [](const Hidden& e, const PlaceMotion& m) { return -e["damping"] * m.v; }},
    {"coulomb", [](const Hidden& e, const PlaceMotion& m) { return -e["level"] * sign_of(e, m.v); }},
    {"stribeck", [](const Hidden& e, const PlaceMotion& m) { return -sliding(e, m.v) * sign_of(e, m.v); }},
    {"viscous_directional",
     [](const Hidden& e, const PlaceMotion& m) { return -e["difference"] * std::abs(m.v); }},
    {"coulomb_directional",
     [](const Hidden& e, const PlaceMotion& m) { return -e["difference"] * std::pow(sign_of(e, m.v), 2); }},
    {"quadratic", [](const Hidden& e, const PlaceMotion& m) { return -e["drag"] * m.v * std::abs(m.v); }},
    {"gear_friction",
     [](const Hidden& e, const PlaceMotion& m) {
       return -e["coefficient"] * std::abs(m.load) * sign_of(e, m.v);
     }},
    {"load_friction",
     [](const Hidden& e, const PlaceMotion& m) {
       return -e["coefficient"] * std::abs(m.load) * sign_of(e, m.v);
     }},
    {"cogging",
     [](const Hidden& e, const PlaceMotion& m) {
       return -e["sine"] * std::sin(e["cycles"] * m.x) - e["cosine"] * std::cos(e["cycles"] * m.x);
     }},
    {"spring", [](const Hidden& e, const PlaceMotion& m) { return e["stiffness"] * (e["rest"] - m.x); }},
    {"preload", [](const Hidden& e, const PlaceMotion&) { return -e["preload"]; }},
    {"hardening", [](const Hidden& e,
                     const PlaceMotion& m) { return e["cubic_stiffness"] * std::pow(e["rest"] - m.x, 3); }},
    {"hysteresis",
     [](const Hidden& e, const PlaceMotion& m) {
       return -e["loss"] * std::abs(m.x - e["rest"]) * sign_of(e, m.v);
     }},
    {"unilateral_spring", one_sided_spring},
    {"hard_stop", stop_force},
    {"gear_efficiency",
     [](const Hidden& e, const PlaceMotion& m) {
       const double share = m.load * m.v > 0.0 ? e["loss_driving"] : e["loss_driven"];
       return -share * std::abs(m.load) * sign_of(e, m.v);
     }},
    {"asymmetric_spring",
     [](const Hidden& e, const PlaceMotion& m) {
       const double out = m.x - e["rest"];
       return -e["stiffness_above"] * std::max(out, 0.0) - e["stiffness_below"] * std::min(out, 0.0);
     }},
    {"lugre", nullptr},
    {"resonator", nullptr},
    {"slipping_coupling", nullptr},
    // Laws that no catalogue has.
    {"sticky_spot",
     [](const Hidden& e, const PlaceMotion& m) {
       const double u = (m.x - e["centre"]) / e["width"];
       return -e["level"] * std::exp(-u * u) * std::tanh(m.v / e["speed"]);
     }},
    {"pressing_friction",
     [](const Hidden& e, const PlaceMotion& m) {
       return -e["damping"] * (1.0 + std::cos(e["waves"] * m.x)) * m.v;
     }},
    {"thickening_oil",
     [](const Hidden& e, const PlaceMotion& m) { return -e["drag"] * std::pow(std::abs(m.v), 3) * m.v; }},
    {"eddy_brake",
     [](const Hidden& e, const PlaceMotion& m) {
       return -2.0 * e["peak"] / (m.v / e["speed"] + e["speed"] / m.v);  // at rest: -0
     }},
    {"detent",
     [](const Hidden& e, const PlaceMotion& m) {
       const double u = (m.x - e["centre"]) / e["width"];
       return -e["force"] * u * std::exp(0.5 * (1.0 - u * u));
     }},
    {"two_waves",
     [](const Hidden& e, const PlaceMotion& m) {
       return e["force"] * (std::sin(7.3 * m.x) + std::cos(17.9 * m.x));
     }},
    {"rail_magnets",
     [](const Hidden& e, const PlaceMotion& m) {
       return e["amplitude"] * std::sin(2.0 * 3.14159265358979323846 * m.x / e["pitch"]);
     }},
}};

const Named* find(const std::string& name) {
  const auto* found =
      std::find_if(kForces.begin(), kForces.end(), [&](const Named& one) { return name == one.name; });
  return found == kForces.end() ? nullptr : found;
}

// Of motors, bodies, sensors and the ground: carried out where these are.
constexpr std::array kOthers{
    "torque_bias", "torque_ripple", "winding", "battery", "harmonic_drive", "sensor_lag", "lost_counts",
    "torque_saturation", "voltage_limit", "thermal_motor", "torque_constant_error", "actuator_lag",
    "current_loop", "command_delay", "bus_delay", "clock_drift", "rotor_inertia", "cable_stretch", "backlash",
    "added_mass", "com_shift", "payload", "gravity_tilt", "encoder_offset", "encoder_scale",
    "encoder_eccentricity", "ground_stiffness_error", "ground_damping_error", "ground_friction_error",
    // Laws that no catalogue has; equations in outside.cpp.
    "creeping_load", "tilting_mount", "held_reading", "heavy_bit", "slow_reversal", "weakening_ends"};

}  // namespace

double Hidden::operator[](std::string_view name) const {
  // Few, and looked up in every step: most differ in their length already.
  for (const auto& [known, value] : values) {
    if (known.size() == name.size() && name == known) return value;
  }
  return 0.0;
}

Hidden hidden_from(const std::string& text) {
  const std::size_t at = text.find('@');
  const std::size_t colon = text.find(':');
  if (at == std::string::npos) {
    throw std::invalid_argument("no place in " + text);
  }
  Hidden hidden{text.substr(0, at), text.substr(at + 1, colon - at - 1), {}};
  if (!is_known(hidden.effect)) {
    throw std::invalid_argument("no foreign world has " + hidden.effect);
  }
  if (colon == std::string::npos) {
    return hidden;
  }
  std::stringstream items(text.substr(colon + 1));
  for (std::string item; std::getline(items, item, ',');) {
    const std::size_t equal = item.find('=');
    hidden.values[item.substr(0, equal)] = std::stod(item.substr(equal + 1));
  }
  return hidden;
}

bool is_force(const Hidden& effect) { return find(effect.effect) != nullptr; }

Law law_of(const Hidden& effect) {
  const Named* found = find(effect.effect);
  return found == nullptr ? nullptr : found->law;
}

int states_of(const Hidden& effect) {
  const bool is_one = effect.effect == "lugre" || effect.effect == "slipping_coupling";
  return effect.effect == "resonator" ? 2 : is_one ? 1 : 0;
}

double force(const Hidden& effect, const PlaceMotion& m, const double* states) {
  const Named* found = find(effect.effect);
  if (found == nullptr) {
    return 0.0;
  }
  if (found->law != nullptr) {
    return found->law(effect, m);
  }
  double rates[2] = {0.0, 0.0};
  state_rates(effect, m, states, rates);
  if (effect.effect == "resonator") {
    return -effect["inertia"] * rates[1];  // what pulls the mass pulls the link back
  }
  if (effect.effect == "slipping_coupling") {
    return -effect["stiffness"] * states[0] - effect["damping"] * rates[0];
  }
  return -effect["stiffness"] * states[0] - effect["bristle_damping"] * rates[0] - effect["viscous"] * m.v;
}

// Bristles: Canudas de Wit, Olsson, Astrom and Lischinsky (1995), equations 1 and 2. A mass m on a spring k
// and a damper c: m s'' = -k e - c e', e = s - x its stretch; states e and s'.
void state_rates(const Hidden& effect, const PlaceMotion& m, const double* states, double* rates) {
  if (effect.effect == "resonator") {
    const double mass = effect["inertia"];
    const double spring = mass * std::pow(6.283185307179586 * effect["frequency"], 2);
    const double damper = 2.0 * effect["damping_ratio"] * std::sqrt(spring * mass);
    rates[0] = states[1] - m.v;
    rates[1] = -(spring * states[0] + damper * rates[0]) / mass;
    return;
  }
  if (effect.effect == "slipping_coupling") {  // an elastic and perfectly plastic piece: Prandtl's
    const double pull = effect["stiffness"] * states[0];
    rates[0] = std::abs(pull) >= effect["limit"] && pull * m.v > 0.0 ? 0.0 : m.v;
    return;
  }
  rates[0] = m.v - effect["stiffness"] * std::abs(m.v) * states[0] / sliding(effect, m.v);
}

bool is_of_drive(const Hidden& effect) {
  return effect.effect == "torque_saturation" || effect.effect == "voltage_limit" ||
         effect.effect == "torque_ripple" || effect.effect == "weakening_ends";
}

// The circuit of the winding, in units in which the torque constant is 1: voltage and speed, current and
// torque are then the same number, and R = voltage/stall torque.
double delivered(const Hidden& effect, double asked, double x, double v) {
  if (effect.effect == "torque_ripple") {  // one wave, by how high it is and where it begins
    const double phase = std::atan2(effect["sine"], effect["cosine"]);
    return asked *
           (1.0 + std::hypot(effect["sine"], effect["cosine"]) * std::cos(effect["cycles"] * x - phase));
  }
  if (effect.effect == "weakening_ends") {
    return weakened(effect, asked, x);
  }
  if (effect.effect == "torque_saturation") {
    const double limit = 1.0 / std::sqrt(effect["sag"]);
    return limit * std::sin(std::atan(asked / limit));
  }
  const double voltage = effect["no_load_speed"];
  const double resistance = voltage / effect["stall_torque"];
  const double needed = resistance * asked + v;
  if (std::abs(needed) <= voltage) {
    return asked;
  }
  return ((needed > 0.0 ? voltage : -voltage) - v) / resistance;
}

// L di/dt + R i + K w = U, in units in which K is 1.
double current_rate(const Hidden& winding, double asked, double current, double v) {
  const bool turns = winding["slope"] > 0.0;
  const double resistance = turns ? 1.0 / winding["slope"] : 1.0;
  const double inductance = winding["time_constant"] * resistance;
  return (resistance * (asked - current) - (turns ? v : 0.0)) / inductance;
}

// Full, the battery has 1 V; each motor has K = 1 and R = stall_sag/speed_sag, and its amplifier a share d of
// the battery's voltage V for it: i = (d V - w)/R flows in the motor, d i in the battery.
double battery_voltage(const Hidden& battery, const std::vector<double>& asked,
                       const std::vector<double>& speeds) {
  const double inner = battery["speed_sag"];
  const double resistance = battery["stall_sag"] / inner;
  double voltage = 1.0;
  for (int round = 0; round < 60; ++round) {  // Ohm's law again and again: each time nearer by its sag
    double drawn = 0.0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const double share = asked[i] * resistance;
      drawn += share * (share * voltage - speeds[i]) / resistance;
    }
    voltage = 1.0 - inner * drawn;
  }
  return voltage;
}

bool is_compliance(const Hidden& effect) {
  return effect.effect == "cable_stretch" || effect.effect == "backlash" ||
         effect.effect == "harmonic_drive" || effect.effect == "slipping_coupling";
}

double compliance_force(const Hidden& effect, double x, double v) {
  if (effect.effect == "cable_stretch") {
    return -effect["stiffness"] * x - effect["damping"] * v;
  }
  if (effect.effect == "harmonic_drive") {  // a spring, and another beside it beyond the windup
    const double over = std::max(0.0, std::abs(x) - effect["windup"]);
    const double more = effect["stiffness_stiff"] - effect["stiffness_soft"];
    return -effect["stiffness_soft"] * x - more * std::copysign(over, x) - effect["damping"] * v;
  }
  // A spring with a dead zone, whose surfaces push and never pull.
  const double half = 0.5 * effect["gap"];
  if (x > half) {
    return -std::max(0.0, effect["stiffness"] * (x - half) + effect["damping"] * v);
  }
  if (x < -half) {
    return std::max(0.0, effect["stiffness"] * (-x - half) - effect["damping"] * v);
  }
  return 0.0;
}

bool is_known(const std::string& effect) {
  return find(effect) != nullptr || effect == "ground_height_error" ||
         std::find(kOthers.begin(), kOthers.end(), effect) != kOthers.end();
}

}  // namespace plumbline::battery::worlds
