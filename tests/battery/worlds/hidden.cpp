#include "tests/battery/worlds/hidden.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

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

/// A stop takes up force behind its position only, and never pulls.
double stop_force(const Hidden& e, const PlaceMotion& m) {
  const double deep = e["side"] * (m.x - e["position"]);
  if (deep <= 0.0) {
    return 0.0;
  }
  const double in = e["side"] * m.v;
  const double rounding = e["rounding"];
  const double root = in > 0.0 ? std::sqrt(in + rounding) - std::sqrt(rounding) : 0.0;
  return -e["side"] *
         (e["cubic_stiffness"] * deep * deep * deep + e["damping"] * in + e["root_damping"] * root);
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

constexpr std::array<Named, 22> kForces{{
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
    {"lugre", nullptr},
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
constexpr std::array<const char*, 16> kOthers{"torque_bias",
                                              "torque_constant_error",
                                              "actuator_lag",
                                              "command_delay",
                                              "rotor_inertia",
                                              "cable_stretch",
                                              "backlash",
                                              "added_mass",
                                              "com_shift",
                                              "payload",
                                              "gravity_tilt",
                                              "encoder_offset",
                                              "encoder_scale",
                                              "ground_stiffness_error",
                                              "ground_damping_error",
                                              "ground_friction_error"};

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

bool has_state(const Hidden& effect) { return effect.effect == "lugre"; }

double force(const Hidden& effect, const PlaceMotion& m, double state) {
  const Named* found = find(effect.effect);
  if (found == nullptr) {
    return 0.0;
  }
  if (found->law != nullptr) {
    return found->law(effect, m);
  }
  return -effect["stiffness"] * state - effect["bristle_damping"] * state_rate(effect, m, state) -
         effect["viscous"] * m.v;
}

// Canudas de Wit, Olsson, Astrom and Lischinsky (1995), equations 1 and 2.
double state_rate(const Hidden& effect, const PlaceMotion& m, double state) {
  return m.v - effect["stiffness"] * std::abs(m.v) * state / sliding(effect, m.v);
}

bool is_compliance(const Hidden& effect) {
  return effect.effect == "cable_stretch" || effect.effect == "backlash";
}

double compliance_force(const Hidden& effect, double x, double v) {
  if (effect.effect == "cable_stretch") {
    return -effect["stiffness"] * x - effect["damping"] * v;
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
