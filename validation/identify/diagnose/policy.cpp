#include "validation/identify/diagnose/policy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::validation {

double PolicyConstant::value(const Policy& policy) const {
  return std::visit([&](auto at) { return static_cast<double>(policy.*at); }, member);
}

void PolicyConstant::scale(Policy& policy, double factor) const {
  set(policy, origin + factor * (value(policy) - origin));
}

void PolicyConstant::set(Policy& policy, double value) const {
  if (const auto* number = std::get_if<double Policy::*>(&member)) {
    policy.** number = value;
  } else {
    policy.*std::get<int Policy::*>(member) = std::max(1, static_cast<int>(std::lround(value)));
  }
}

const std::vector<PolicyConstant>& policy_constants() {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  static const std::vector<PolicyConstant> kConstants{
      {"at_floor", &Policy::at_floor, 1.0},
      {"finished", &Policy::finished, 1.0},
      {"far", &Policy::far, 1.0, kNever},
      {"hopeless", &Policy::hopeless, 1.0, kNever},
      {"nearer", &Policy::nearer, 1.0, kNever},
      {"material", &Policy::material, 0.0, 0.0},
      {"simpler", &Policy::simpler, 0.0, 0.0},
      {"simpler_far", &Policy::simpler_far, 0.0, 0.02},
      {"stable", &Policy::stable, 1.0, 0.0},
      {"fair", &Policy::fair, 0.0, 0.0},
      {"told", &Policy::told, 0.0, 0.0},
      {"parameter_width", &Policy::parameter_width, 0.0, 100.0},
      {"evidence", &Policy::evidence, 0.0, 1.0},
      {"most_effects", &Policy::most_effects, 0.0, 12.0},
      {"most_as_stated", &Policy::most_as_stated, 0.0, 4.0},
      {"refits", &Policy::refits, 0.0, 16.0},
      {"refits_segments", &Policy::refits_segments, 0.0, 8.0},
      {"constants", &Policy::constants, 0.0, 8.0},
      {"firsts", &Policy::firsts, 0.0, 8.0},
      {"seconds", &Policy::seconds, 0.0, 8.0},
      {"linear_pairs", &Policy::linear_pairs, 0.0, 20.0},
      {"near_best", &Policy::near_best, 0.0, kNever},
      {"kept_promise", &Policy::kept_promise, 0.0, kNever},
      {"still_better", &Policy::still_better, 0.0, 1.0},
      {"explained", &Policy::explained, 0.0, 0.0},
  };
  return kConstants;
}

}  // namespace plumbline::validation
