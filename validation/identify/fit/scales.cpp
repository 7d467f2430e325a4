#include "validation/identify/fit/scales.h"

#include <algorithm>
#include <cmath>

#include "simulator/effects/parameters.h"
#include "simulator/trace/error.h"
#include "validation/identify/diagnose/candidates.h"

namespace plumbline::validation {
namespace {

using effects::Place;

bool is_a_position(Place place) {
  return place == Place::coordinate || place == Place::motor || place == Place::ratio;
}

/// How far `at` moves when `of` moves by one; both are tied to each other.
double travel(model::Plant& plant, const std::string& at, const std::string& of) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  for (Eigen::Index i = 0; i < plant.positions(); ++i) {
    x[plant.positions() + i] = 1.0;
    const double moved = plant.velocity_of(of, x.data());
    if (moved != 0.0) {
      return plant.velocity_of(at, x.data()) / moved;
    }
    x[plant.positions() + i] = 0.0;
  }
  return 1.0;
}

}  // namespace

effects::Scales scales_at(const model::Model& model, const std::shared_ptr<const effects::Law>& law,
                          const std::string& at, const Data& data) {
  if (!data.has(Role::train)) {
    const Trial& other = data.trials.empty() ? data.tests.front() : data.trials.front();
    throw InputError({other.file, 0, "role"}, to_string(other.role), "at least one trial with role: train");
  }
  PredictorPool pool(model, data);
  for (const Candidate& candidate : list_candidates(pool, effects::Catalogue({law}), {}, {})) {
    if (candidate.at == at) {
      return candidate.scales;
    }
    const auto& same = candidate.same_places;
    if (std::find(same.begin(), same.end(), at) != same.end()) {
      model::Plant plant(model, {});
      return effects::seen_from(candidate.scales, travel(plant, at, candidate.at));
    }
  }
  return scales_at(model, *law, at);  // a place that the trials do not show, such as an unmeasured sensor
}

effects::Scales scales_at(const model::Model& model, const effects::Law& law, const std::string& at) {
  effects::Scales scales;
  const Place place = model.resolve(law, at);
  if (place == Place::body) {
    scales.inertia = model.skeleton.bodies[static_cast<std::size_t>(model.body_index(at))].mass;
    scales.position = 0.1;
  }
  if (!is_a_position(place)) {
    return scales;
  }
  model::Plant plant(model, {});
  const bool is_rod = place == Place::ratio && model.find_rod(at) != nullptr;
  const model::Plant::Lever lever = is_rod ? plant.lever_of(at) : model::Plant::Lever{at, 1.0};
  const std::string seen = place == Place::ratio && !is_rod ? model.find_ratio(at)->motor : lever.coordinate;
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const Eigen::VectorXd idle = Eigen::VectorXd::Zero(plant.motors());
  Eigen::VectorXd rate(plant.states());
  plant.rate(x.data(), idle.data(), rate.data());
  scales.inertia = plant.inertia_of(seen);
  if (place == Place::ratio) {
    scales.inertia *= 0.25;  // the two sides of a released ratio swing against each other
  }
  const model::Motor* motor = model.find_motor(seen);
  if (motor != nullptr && motor->torque_limit.value > 0.0) {
    scales.force = motor->torque_limit.value;
  }
  return is_rod ? effects::seen_from(scales, lever.travel) : scales;
}

}  // namespace plumbline::validation
