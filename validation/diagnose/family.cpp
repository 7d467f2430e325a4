#include "validation/diagnose/family.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace plumbline::validation {
namespace {

/// By the names of their laws. A law that is in none is a family of its own.
const std::vector<std::vector<std::string>>& families() {
  static const std::vector<std::vector<std::string>> kFamilies{
      {"viscous", "viscous_directional", "quadratic", "coulomb", "coulomb_directional", "stribeck", "lugre",
       "hysteresis", "load_friction", "transmitted_load_friction"},
      {"spring", "preload", "unilateral_spring", "hardening", "hard_stop"},
      {"actuator_lag", "command_delay"},
      {"torque_constant_error", "torque_bias"},
      {"cable_stretch", "backlash"},
      {"encoder_offset", "encoder_scale"}};
  return kFamilies;
}

int family_of(const model::EffectUse& use) {
  const std::string& law = use.law->declaration().name;
  for (std::size_t f = 0; f < families().size(); ++f) {
    if (std::find(families()[f].begin(), families()[f].end(), law) != families()[f].end()) {
      return static_cast<int>(f);
    }
  }
  return -1;
}

}  // namespace

bool are_of_one_family(const model::EffectUse& one, const model::EffectUse& other) {
  return one.at == other.at && family_of(one) >= 0 && family_of(one) == family_of(other);
}

}  // namespace plumbline::validation
