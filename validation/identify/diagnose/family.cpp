#include "validation/identify/diagnose/family.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "simulator/model/plant.h"

namespace plumbline::validation {
namespace {

/// By the names of their laws, friction first. A law that is in none is a family of its own.
const std::vector<std::vector<std::string>>& families() {
  static const std::vector<std::vector<std::string>> kFamilies{
      {"viscous", "viscous_directional", "quadratic", "coulomb", "coulomb_directional", "stribeck", "lugre",
       "hysteresis", "load_friction", "gear_friction", "gear_efficiency"},
      {"spring", "preload", "unilateral_spring", "asymmetric_spring", "hardening", "hard_stop"},
      {"actuator_lag", "current_loop", "command_delay", "bus_delay", "clock_drift", "winding"},
      {"torque_constant_error", "torque_bias", "torque_saturation", "voltage_limit", "thermal_motor"},
      {"cable_stretch", "backlash", "harmonic_drive", "slipping_coupling"},
      {"cogging", "torque_ripple"},
      {"encoder_offset", "encoder_scale", "encoder_eccentricity", "sensor_lag", "lost_counts"},
      {"imu_bias", "imu_scale", "imu_misalignment"}};
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

bool may_be_payload(const std::string& law) { return law == "added_mass" || law == "com_shift"; }

TiedPlaces::TiedPlaces(const model::Model& model) {
  const model::Plant plant(model, {});
  const auto add = [&](const std::string& name) {
    Eigen::VectorXd direction(plant.positions());
    for (Eigen::Index i = 0; i < direction.size(); ++i) {
      Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
      x[plant.positions() + i] = 1.0;
      direction[i] = plant.velocity_of(name, x.data());
    }
    directions_.emplace(name, direction.normalized());
  };
  for (const model::Coordinate& coordinate : model.coordinates) {
    add(coordinate.name);
  }
  for (const model::Motor& motor : model.motors) {
    add(motor.name);
  }
}

bool TiedPlaces::are_one(const std::string& a, const std::string& b) const {
  constexpr double kParallel = 1.0 - 1e-9;
  const auto one = directions_.find(a);
  const auto other = directions_.find(b);
  return a == b || (one != directions_.end() && other != directions_.end() &&
                    std::abs(one->second.dot(other->second)) > kParallel);
}

bool are_of_one_family(const effects::Law& one, const effects::Law& other) {
  return family_of(one) >= 0 && family_of(one) == family_of(other);
}

bool are_of_one_family(const model::EffectUse& one, const model::EffectUse& other, const TiedPlaces& places) {
  return places.are_one(one.at, other.at) && are_of_one_family(*one.law, *other.law);
}

}  // namespace plumbline::validation
