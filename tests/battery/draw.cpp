#include "tests/battery/draw.h"

#include <fmt/core.h>

#include <sstream>
#include <stdexcept>
#include <vector>

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
  if (parts.size() == 2 && strength == Strength::medium) {
    throw std::invalid_argument("'" + text + "' has no medium strength");
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

double Draw::factor() {
  const double unit = static_cast<double>(random_() >> 11U) * 0x1.0p-53;  // in [0, 1)
  return 1.0 + kSpread * (2.0 * unit - 1.0);
}

std::string drawn_effect(const Case& one, const effects::Catalogue& catalogue, Draw& draw) {
  const auto law = catalogue.find(one.row.effect);
  if (!law) {
    throw std::invalid_argument("unknown effect '" + one.row.effect + "'");
  }
  std::string text = one.row.effect + "@" + one.row.at;
  char separator = ':';
  std::stringstream items(one.row.parameters);
  for (std::string item; std::getline(items, item, ',');) {
    const std::size_t equal = item.find('=');
    const std::string parameter = item.substr(0, equal);
    const int index = law->parameter_index(parameter);
    if (equal == std::string::npos || index < 0) {
      throw std::invalid_argument("unknown parameter '" + parameter + "'");
    }
    const Nominal nominal = read_value(item.substr(equal + 1), one.strength);
    const bool structural = law->declaration().parameters[static_cast<std::size_t>(index)].structural;
    const double factor = structural ? 1.0 : draw.factor();
    text += fmt::format("{}{}={:.6g}", separator, parameter, nominal.base + factor * nominal.varied);
    separator = ',';
  }
  return text;
}

}  // namespace plumbline::battery
