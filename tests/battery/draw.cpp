#include "tests/battery/draw.h"

#include <fmt/core.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "simulator/effects/parameters.h"

namespace plumbline::battery {
namespace {

/// FNV-1a, 64 bit: the standard library's hash may differ between platforms.
std::uint64_t hash(const std::string& text) {
  std::uint64_t value = 14695981039346656037ULL;
  for (const char letter : text) {
    value = (value ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  }
  return value;
}

std::mt19937_64 seeded(const std::string& name, std::uint64_t seed) {
  const std::uint64_t key = hash(name);
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U)};
  return std::mt19937_64(sequence);
}

double number(const std::string& text) {
  std::size_t used = 0;
  const double value = std::stod(text, &used);  // throws std::invalid_argument
  if (used != text.size()) {
    throw std::invalid_argument("'" + text + "' is no number");
  }
  return value;
}

/// Where the part after a base begins: a sign that neither leads nor belongs to an exponent. npos: no base.
std::size_t end_of_base(const std::string& text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    const bool sign = text[i] == '+' || text[i] == '-';
    if (sign && text[i - 1] != 'e' && text[i - 1] != '|') {
      return i;
    }
  }
  return std::string::npos;
}

struct Nominal {
  double base = 0.0;
  double varied = 0.0;
};

/// WEAK|STRONG or WEAK|MEDIUM|STRONG
double of_strength(const std::string& text, Strength strength) {
  std::vector<std::string> parts;
  std::stringstream all(text);
  for (std::string part; std::getline(all, part, '|');) {
    parts.push_back(part);
  }
  if (parts.size() == 1) {
    return number(text);
  }
  if (parts.size() == 2 && strength == Strength::medium) {
    return std::copysign(std::sqrt(number(parts[0]) * number(parts[1])), number(parts[0]));
  }
  if (parts.size() > 3) {
    throw std::invalid_argument("'" + text + "' gives more than three strengths");
  }
  return number(strength == Strength::weak     ? parts.front()
                : strength == Strength::medium ? parts[1]
                                               : parts.back());
}

/// [BASE(+|-)]NUMBER, or strengths in the number's place
Nominal read_value(const std::string& text, Strength strength) {
  const std::size_t split = end_of_base(text);
  const std::string varied = split == std::string::npos ? text : text.substr(split + 1);
  Nominal nominal;
  nominal.varied = of_strength(varied, strength);
  if (split != std::string::npos) {
    nominal.base = number(text.substr(0, split));
    nominal.varied *= text[split] == '-' ? -1.0 : 1.0;
  }
  return nominal;
}

}  // namespace

Draw::Draw(const Case& one, std::uint64_t seed) : random_(seeded(one.name, seed)) {}

double Draw::unit() { return static_cast<double>(random_() >> 11U) * 0x1.0p-53; }

double Draw::factor() { return 1.0 + kSpread * (2.0 * unit() - 1.0); }

double Draw::deviations() {
  // Box and Muller; drawn again beyond two deviations. std::normal_distribution differs between platforms.
  for (;;) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
    const double normal = radius * std::cos(2.0 * effects::kPi * unit());
    if (std::abs(normal) <= kMostDeviations) {
      return normal;
    }
  }
}

std::string drawn_effect(const Row& row, Strength strength, const effects::Catalogue& catalogue, Draw& draw) {
  const auto law = catalogue.find(row.effect);
  if (!law) {
    throw std::invalid_argument("unknown effect '" + row.effect + "'");
  }
  std::string text = row.effect + "@" + row.at;
  char separator = ':';
  std::stringstream items(row.parameters);
  for (std::string item; std::getline(items, item, ',');) {
    const std::size_t equal = item.find('=');
    const std::string parameter = item.substr(0, equal);
    const int index = law->parameter_index(parameter);
    if (equal == std::string::npos || index < 0) {
      throw std::invalid_argument("unknown parameter '" + parameter + "'");
    }
    const Nominal nominal = read_value(item.substr(equal + 1), strength);
    const bool structural = law->declaration().parameters[static_cast<std::size_t>(index)].structural;
    const double factor = structural ? 1.0 : draw.factor();
    // What is added to a base may be small beside it.
    const int digits = nominal.base != 0.0 ? 9 : 6;
    text += fmt::format("{}{}={:.{}g}", separator, parameter, nominal.base + factor * nominal.varied, digits);
    separator = ',';
  }
  return text;
}

model::Model scattered(const model::Model& stated, Draw& draw) {
  model::Model robot = stated;
  for (model::Body& body : robot.skeleton.bodies) {
    const double factor = body.mass > 0.0 ? 1.0 + draw.deviations() * body.mass_uncertainty / body.mass : 1.0;
    body.mass *= factor;
    body.inertia *= factor;
  }
  for (model::EffectUse& use : robot.effects) {
    for (model::Quantity& value : use.values) {
      value.value += draw.deviations() * value.uncertainty;
    }
  }
  for (model::Motor& motor : robot.motors) {
    motor.rotor_inertia.value += draw.deviations() * motor.rotor_inertia.uncertainty;
    const double share = motor.torque_constant.uncertainty / motor.torque_constant.value;
    model::Quantity scale;
    scale.value = 1.0 + draw.deviations() * share;
    if (share > 0.0) {
      robot.effects.push_back(
          {effects::Catalogue::all().find("torque_constant_error"), motor.name, {scale}, 0});
    }
  }
  return robot;
}

}  // namespace plumbline::battery
