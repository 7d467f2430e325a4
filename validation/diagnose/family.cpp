#include "validation/diagnose/family.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace plumbline::validation {
namespace {

/// By the names of their laws, friction first. A law that is in none is a family of its own.
const std::vector<std::vector<std::string>>& families() {
  static const std::vector<std::vector<std::string>> kFamilies{
      {"viscous", "viscous_directional", "quadratic", "coulomb", "coulomb_directional", "stribeck", "lugre",
       "hysteresis", "load_friction", "gear_friction"},
      {"spring", "preload", "unilateral_spring", "hardening", "hard_stop"},
      {"actuator_lag", "command_delay"},
      {"torque_constant_error", "torque_bias"},
      {"cable_stretch", "backlash"},
      {"encoder_offset", "encoder_scale"}};
  return kFamilies;
}

constexpr int kFriction = 0;

int family_of(const effects::Law& law) {
  const std::string& name = law.declaration().name;
  for (std::size_t f = 0; f < families().size(); ++f) {
    if (std::find(families()[f].begin(), families()[f].end(), name) != families()[f].end()) {
      return static_cast<int>(f);
    }
  }
  return -1;
}

}  // namespace

bool is_friction(const effects::Law& law) { return family_of(law) == kFriction; }

bool are_of_one_family(const model::EffectUse& one, const model::EffectUse& other) {
  return one.at == other.at && family_of(*one.law) >= 0 && family_of(*one.law) == family_of(*other.law);
}

}  // namespace plumbline::validation
