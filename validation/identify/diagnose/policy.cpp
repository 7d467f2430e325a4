#include "validation/identify/diagnose/policy.h"

#include <algorithm>
#include <cmath>

namespace plumbline::validation {

double PolicyConstant::value(const Policy& policy) const {
  return std::visit([&](auto at) { return static_cast<double>(policy.*at); }, member);
}

void PolicyConstant::scale(Policy& policy, double factor) const {
  const double scaled = origin + factor * (value(policy) - origin);
  if (const auto* number = std::get_if<double Policy::*>(&member)) {
    policy.** number = scaled;
  } else {
    policy.*std::get<int Policy::*>(member) = std::max(1, static_cast<int>(std::lround(scaled)));
  }
}

const std::vector<PolicyConstant>& policy_constants() {
  static const std::vector<PolicyConstant> kConstants{
      {"at_floor", &Policy::at_floor, 1.0},
      {"nothing", &Policy::nothing, 1.0},
      {"finished", &Policy::finished, 1.0},
      {"far", &Policy::far, 1.0},
      {"hopeless", &Policy::hopeless, 1.0},
      {"nearer", &Policy::nearer, 1.0},
      {"material", &Policy::material},
      {"simpler", &Policy::simpler},
      {"simpler_far", &Policy::simpler_far},
      {"stable", &Policy::stable, 1.0},
      {"fair", &Policy::fair},
      {"same", &Policy::same},
      {"consistent", &Policy::consistent},
      {"consistent_far", &Policy::consistent_far},
      {"told", &Policy::told},
      {"near_nothing", &Policy::near_nothing},
      {"parameter_width", &Policy::parameter_width},
      {"evidence", &Policy::evidence},
      {"promised", &Policy::promised},
      {"own_share", &Policy::own_share},
      {"harmful", &Policy::harmful},
      {"group_rest", &Policy::group_rest},
      {"group_better", &Policy::group_better},
      {"most_effects", &Policy::most_effects},
      {"most_as_stated", &Policy::most_as_stated},
      {"refits", &Policy::refits},
      {"refits_segments", &Policy::refits_segments},
      {"constants", &Policy::constants},
      {"firsts", &Policy::firsts},
      {"seconds", &Policy::seconds},
      {"linear_pairs", &Policy::linear_pairs},
      {"near_best", &Policy::near_best},
      {"kept_promise", &Policy::kept_promise},
      {"still_better", &Policy::still_better},
      {"explained", &Policy::explained},
  };
  return kConstants;
}

}  // namespace plumbline::validation
