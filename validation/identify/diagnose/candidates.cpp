#include "validation/identify/diagnose/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/ground_change.h"
#include "contact/ground_turning.h"
#include "simulator/effects/inertial_sensor_law.h"
#include "simulator/effects/parameters.h"
#include "simulator/model/limbs.h"
#include "simulator/model/places.h"
#include "simulator/model/planar_base.h"
#include "simulator/trace/error.h"
#include "validation/identify/diagnose/inertial_places.h"
#include "validation/identify/diagnose/physical_limits.h"
#include "validation/identify/diagnose/rates.h"

namespace plumbline::validation {
namespace {

using effects::Place;

// The two sides of what is released swing against each other: about a quarter of their sum.
constexpr double kPartThatSwings = 0.25;

/// Typical magnitudes of the motion of a place over the train windows, from the measurements.
class PlaceMotions {
 public:
  PlaceMotions(PredictorPool& pool, const std::vector<FreeParameter>& parameters, const Estimate& estimate)
      : pool_(pool), parameters_(parameters), estimate_(estimate) {}

  effects::Scales at(Place place, const std::string& name) {
    const std::string key = effects::to_string(place) + " " + name;
    const auto found = known_.find(key);
    if (found != known_.end()) {
      return found->second;
    }
    const bool is_rod = place == Place::ratio && pool_.model().find_rod(name) != nullptr;
    return known_[key] = is_rod ? measure_rod(name) : measure(place, name);
  }

 private:
  effects::Scales measure(Place place, const std::string& name);
  effects::Scales measure_rod(const std::string& name);

  PredictorPool& pool_;
  const std::vector<FreeParameter>& parameters_;
  const Estimate& estimate_;
  std::map<std::string, effects::Scales> known_;
};

/// Root mean square of the torques of a trial's motors, carried over to a place: the square root of the
/// inertias' ratio is about the gear ratio between motor and place.
double driving_force(model::Plant& plant, const Trial& trial, double inertia) {
  double square = 0.0;
  for (const Command& command : trial.commands) {
    for (int m = 0; m < plant.motors(); ++m) {
      const std::string& motor = plant.model().motors[static_cast<std::size_t>(m)].name;
      const double felt = plant.inertia_of(motor);
      if (command.motor == motor && std::isfinite(felt)) {
        square += std::pow(plant.torque_gain(m), 2) * inertia / felt * command.values.squaredNorm() /
                  static_cast<double>(command.values.size());
      }
    }
  }
  return std::sqrt(square);
}

/// Root mean square of a trial's largest force plate: what the legs carry.
double carried_force(const model::Model& model, const Trial& trial) {
  double force = 0.0;
  for (const Measured& channel : trial.measured) {
    if (model.find_sensor(channel.sensor)->is_force_plate()) {
      force = std::max(force,
                       std::sqrt(channel.values.squaredNorm() / static_cast<double>(channel.values.size())));
    }
  }
  return force;
}

effects::Scales PlaceMotions::measure(Place place, const std::string& name) {
  const Data& data = pool_.data();
  const model::Model& model = pool_.model();
  const std::string seen = place == Place::ratio ? model.find_ratio(name)->motor : name;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double v2 = 0.0;
  double count = 0.0;
  effects::Scales scales;
  scales.force = 0.0;
  scales.inertia = 0.0;
  for (const int w : data.windows_of(Role::train)) {
    const Window& window = data.windows[static_cast<std::size_t>(w)];
    const Trial& trial = data.trials[static_cast<std::size_t>(window.trial)];
    pool_.with(w, parameters_, estimate_.theta, [&](Predictor& predictor) {
      model::Plant& plant = predictor.plant();
      Eigen::VectorXd xdot(plant.states());
      const Eigen::VectorXd idle = Eigen::VectorXd::Zero(plant.motors());
      const bool unseen = !trial.start.empty();  // by the sensors: then as predicted
      if (unseen) {
        predictor.predict(window, estimate_.x0[static_cast<std::size_t>(w)]);
      }
      const Eigen::MatrixXd predicted = unseen ? predictor.predicted_states() : Eigen::MatrixXd();
      for (Eigen::Index k = 0; k + 8 < window.count; k += std::max<Eigen::Index>(1, window.count / 8)) {
        const Eigen::VectorXd x =
            unseen ? Eigen::VectorXd(predicted.col(k))
                   : predictor.initial_state({window.trial, window.first + k, window.count - k});
        if (k == 0) {
          plant.rate(x.data(), idle.data(), xdot.data());
        }
        if (!std::isfinite(plant.inertia_of(seen)) || plant.inertia_of(seen) > 1e9) {
          return;  // locked in this trial
        }
        const double position = plant.position_of(seen, x.data());
        const double velocity = plant.velocity_of(seen, x.data());
        low = std::min(low, position);
        high = std::max(high, position);
        v2 += velocity * velocity;
        count += 1.0;
      }
      scales.inertia = std::max(scales.inertia, plant.inertia_of(seen));
      scales.force = std::max(
          {scales.force, driving_force(plant, trial, plant.inertia_of(seen)), carried_force(model, trial)});
    });
    scales.period = trial.period;
  }
  scales.center = count > 0.0 ? 0.5 * (low + high) : 0.0;
  scales.position = count > 0.0 ? std::max(0.5 * (high - low), 1e-9) : 1.0;
  scales.velocity = count > 0.0 ? std::max(std::sqrt(v2 / count), 1e-9) : 1.0;
  scales.inertia = std::max(scales.inertia, 1e-12);
  // What swings freely is driven by nobody: the force that turns such a motion round is its own inertia's.
  const double turning = scales.inertia * scales.velocity * scales.velocity / scales.position;
  scales.force = std::max({scales.force, count > 0.0 ? turning : 0.0, 1e-9});
  if (place == Place::ratio) {
    scales.inertia *= kPartThatSwings;
  }
  return scales;
}

// The rest of the mechanism drives a rod as a motor does a ratio.
effects::Scales PlaceMotions::measure_rod(const std::string& name) {
  const model::Plant::Lever lever = model::Plant(pool_.model(), {}).lever_of(name);
  effects::Scales scales = effects::seen_from(at(Place::coordinate, lever.coordinate), lever.travel);
  scales.inertia *= kPartThatSwings;
  return scales;
}

/// Direction of a place in the independent coordinates of a plant without locks.
Eigen::VectorXd direction(model::Plant& plant, const std::string& at) {
  Eigen::VectorXd d(plant.positions());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    x[plant.positions() + i] = 1.0;
    d[i] = plant.velocity_of(at, x.data());
    x[plant.positions() + i] = 0.0;
  }
  return d;
}

/// Names of all places of one law, those that are rigidly tied joined into one.
std::vector<std::pair<std::string, std::vector<std::string>>> joined_places(model::Plant& plant,
                                                                            const effects::Law& law,
                                                                            Place* type) {
  std::vector<std::pair<std::string, std::vector<std::string>>> joined;
  std::vector<Eigen::VectorXd> directions;
  std::vector<Place> order = law.declaration().places;
  std::sort(order.begin(), order.end(),
            [](Place a, Place b) { return a == Place::motor && b != Place::motor; });
  for (const Place place : order) {
    *type = place;
    for (const std::string& at : model::places_of(plant.model(), law, place)) {
      if (place != Place::coordinate && place != Place::motor) {
        joined.push_back({at, {}});
        continue;
      }
      const Eigen::VectorXd d = direction(plant, at);
      bool known = false;
      for (std::size_t j = 0; j < directions.size() && !known; ++j) {
        const double scale = d.norm() * directions[j].norm();
        known = scale > 0.0 && std::abs(d.dot(directions[j])) > (1.0 - 1e-9) * scale;
        if (known) {
          joined[j].second.push_back(at);
        }
      }
      if (!known) {
        joined.push_back({at, {}});
        directions.push_back(d);
      }
    }
  }
  return joined;
}

bool is_recorded(const std::vector<Trial>& trials, const std::string& contact_switch) {
  return std::any_of(trials.begin(), trials.end(), [&](const Trial& trial) {
    return std::any_of(trial.switches.begin(), trial.switches.end(),
                       [&](const SwitchRecord& one) { return one.name == contact_switch; });
  });
}

bool is_measured(const std::vector<Trial>& trials, const std::string& sensor) {
  return std::any_of(trials.begin(), trials.end(), [&](const Trial& trial) {
    return std::any_of(trial.measured.begin(), trial.measured.end(),
                       [&](const Measured& channel) { return channel.sensor == sensor; });
  });
}

/// The normal law of a foot, as the model has it; null where it has none.
const model::EffectUse* normal_law_at(const model::Model& model, const std::string& foot) {
  const auto found = std::find_if(model.effects.begin(), model.effects.end(), [&](const auto& use) {
    return use.at == foot && dynamic_cast<const contact::NormalLaw*>(use.law.get()) != nullptr;
  });
  return found == model.effects.end() ? nullptr : &*found;
}

/// The ground itself is never what is missing: only how it differs from what the model says of it, and what a
/// foot that rolls or spins feels beside. A point does neither.
bool changes_ground(const model::Model& model, const effects::Law& law, const std::string& foot) {
  const bool is_round = std::any_of(model.feet.begin(), model.feet.end(), [&](const model::Foot& one) {
    return one.answers_to(foot) && one.radius > 0.0;
  });
  const bool turns = is_round && dynamic_cast<const contact::TurningLaw*>(&law) != nullptr;
  return (turns || dynamic_cast<const contact::GroundChangeLaw*>(&law) != nullptr) &&
         normal_law_at(model, foot) != nullptr;
}

/// Depth at which the foot's ground carries the robot, to a factor of two.
double resting_depth(const model::Model& model, const std::string& foot) {
  const model::EffectUse& use = *normal_law_at(model, foot);
  const auto& law = dynamic_cast<const contact::NormalLaw&>(*use.law);
  const effects::Values p = use.numbers();
  double weight = 0.0;
  for (const model::Body& body : model.skeleton.bodies) {
    weight += body.mass * model.skeleton.gravity.norm();
  }
  double depth = 1e-9;
  while (depth < 1.0 && law.force(depth, 0.0, p.data()) < weight) {
    depth *= 2.0;
  }
  return depth;
}

/// The joint whose position is the height of a robot that has a base.
std::string base_height(const model::Skeleton& skeleton) {
  return skeleton.joints[static_cast<std::size_t>(model::planar_base(skeleton)->upward)].name;
}

/// A link of its own: it moves, and has a mass. What has none carries joints only.
bool is_moving_mass(const model::Skeleton& skeleton, const std::string& name) {
  for (const model::Joint& joint : skeleton.joints) {
    const model::Body& body = skeleton.bodies[static_cast<std::size_t>(joint.child)];
    if (body.name == name) {
      return body.mass > 0.0 && (joint.type != model::JointType::fixed || joint.parent >= 0);
    }
  }
  return false;
}

/// Of a law in space, which the mechanism may not feel in every direction.
std::vector<int> parameters_without_effect(const model::Model& model, const Candidate& candidate) {
  constexpr double kRounding = 1e-12;
  model::Model with = model;
  with.effects.push_back(make_use(candidate, candidate.law->typical(candidate.scales)));
  const Eigen::VectorXd rates = rates_at_random_states(with);
  std::vector<int> found;
  for (std::size_t p = 0; p < with.effects.back().values.size(); ++p) {
    model::Model other = with;
    other.effects.back().values[p].value *= 2.0;
    if ((rates_at_random_states(other) - rates).norm() <= kRounding * rates.norm()) {
      found.push_back(static_cast<int>(p));
    }
  }
  return found;
}

std::string first_motor_on(const model::Model& model, const std::string& limb) {
  return std::find_if(model.motors.begin(), model.motors.end(),
                      [&](const model::Motor& motor) { return is_on_limb(model, limb, motor); })
      ->name;
}

bool is_null(const model::EffectUse& use) { return use.law->is_null(use.numbers().data()); }

/// A law that brings states of its own to the system, by its bristles or by releasing a ratio, and that a
/// parameter at its null value would make nothing, is left next to nothing: initial states that were found
/// with it still fit.
void keep_states(const model::Model& before, const FreeParameter& parameter, model::Model& model) {
  constexpr double kNext = 1e-6, kNextToRigid = 1e-3;  // of the typical value; stiffer costs the integrator
  const auto effect = static_cast<std::size_t>(parameter.id.effect);
  model::EffectUse& use = model.effects[effect];
  const bool brings_states = use.law->state_count() > 0 || use.law->sits_at(Place::ratio);
  if (!brings_states || !is_null(use) || is_null(before.effects[effect])) {
    return;
  }
  const auto p = static_cast<std::size_t>(parameter.id.parameter);
  double& value = use.values[p].value;
  if (value != use.law->declaration().parameters[p].null_value) {
    return;
  }
  const double null = to_search(parameter.scale, value);
  const double next = parameter.scale == effects::Scale::reciprocal ? kNextToRigid : kNext;
  const double step = next * std::abs(to_search(parameter.scale, parameter.typical));
  const double other = from_search(parameter.scale, null + step);
  const bool inside = other >= parameter.lower && other <= parameter.upper;
  value = inside ? other : from_search(parameter.scale, null - step);
}

/// Behind a ratio that stretches only its own inertia holds a side: there may be none, a point mass on the
/// axis, and then there is nothing to ask.
bool leaves_no_inertia(const model::Model& model, const Candidate& candidate) {
  if (candidate.place != Place::ratio) {
    return false;
  }
  model::Model with = model;
  with.effects.push_back(make_use(candidate, candidate.law->typical(candidate.scales)));
  try {
    model::Plant plant(with, {});
  } catch (const InputError&) {
    return true;
  }
  return false;
}

}  // namespace

std::vector<Candidate> list_candidates(PredictorPool& pool, const effects::Catalogue& catalogue,
                                       const std::vector<FreeParameter>& parameters,
                                       const Estimate& estimate) {
  const model::Model& model = pool.model();
  model::Plant plant(model, {});
  PlaceMotions motions(pool, parameters, estimate);
  std::vector<Candidate> candidates;
  for (const auto& law : catalogue.laws()) {
    Place place = Place::coordinate;
    for (const auto& [at, same] : joined_places(plant, *law, &place)) {
      place = model.resolve(*law, at);
      const bool is_inertial = dynamic_cast<const effects::InertialSensorLaw*>(law.get()) != nullptr;
      const std::vector<Trial>& trials = pool.data().trials;
      if (is_inertial ? !is_recorded_inertial(model, trials, at)
                      : place == Place::sensor && !is_measured(trials, at)) {
        continue;
      }
      if (place == Place::contact_switch && !is_recorded(pool.data().trials, at)) {
        continue;
      }
      if (place == Place::body && !is_moving_mass(model.skeleton, at)) {
        continue;
      }
      if (place == Place::foot && !changes_ground(model, *law, at)) {
        continue;
      }
      Candidate candidate{law, place, at, same, {}};
      if (leaves_no_inertia(model, candidate)) {
        continue;
      }
      if (place == Place::coordinate || place == Place::motor || place == Place::ratio) {
        candidate.scales = motions.at(place, at);
      } else if (is_inertial) {
        candidate.scales.position = largest_reading(model, trials, at);
        candidate.without_effect = unseen_parameters(model, trials, candidate);
      } else if (place == Place::sensor) {
        const model::Sensor& sensor = *model.find_sensor(at);
        candidate.scales = motions.at(Place::coordinate, sensor.measures);
      } else if (place == Place::body) {
        candidate.scales.inertia = model.skeleton.bodies[static_cast<std::size_t>(model.body_index(at))].mass;
        candidate.scales.position = 0.1;
        candidate.without_effect = parameters_without_effect(model, candidate);
      } else if (place == Place::contact_switch) {
        candidate.scales.period = pool.data().trials.front().period;
      } else if (place == Place::foot) {
        candidate.scales.position = resting_depth(model, at);
      } else if (place == Place::limb) {
        candidate.scales = motions.at(Place::motor, first_motor_on(model, at));
      } else if (place == Place::base) {
        candidate.scales = motions.at(Place::coordinate, base_height(model.skeleton));
      }
      candidates.push_back(std::move(candidate));
    }
  }
  return candidates;
}

std::vector<effects::Values> starts_of(const model::Model& model, const Candidate& candidate) {
  std::vector<effects::Values> starts = candidate.law->starts(candidate.scales);
  const auto* law = dynamic_cast<const effects::StructureLaw*>(candidate.law.get());
  if (law == nullptr || candidate.place != Place::body) {
    return starts;
  }
  const Eigen::Vector3d& com =
      model.skeleton.bodies[static_cast<std::size_t>(model.body_index(candidate.at))].com;
  constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  for (effects::Values& start : starts) {
    for (std::size_t i = 0; i < kAxes.size() && law->change(start.data()).payload > 0.0; ++i) {
      start[static_cast<std::size_t>(law->parameter_index(kAxes.at(i)))] = com[static_cast<Eigen::Index>(i)];
    }
  }
  return starts;
}

model::EffectUse make_use(const Candidate& candidate, const effects::Values& values) {
  model::EffectUse use;
  use.law = candidate.law;
  use.at = candidate.at;
  for (const double value : values) {
    model::Quantity quantity;
    quantity.value = value;
    use.values.push_back(quantity);
  }
  return use;
}

std::vector<FreeParameter> free_parameters_of(const model::EffectUse& use, int effect,
                                              const effects::Scales& scales, bool angular) {
  std::vector<FreeParameter> free;
  const effects::Declaration& declaration = use.law->declaration();
  const effects::Values typical = use.law->typical(scales);
  for (std::size_t p = 0; p < declaration.parameters.size(); ++p) {
    const effects::Parameter& parameter = declaration.parameters[p];
    if (parameter.structural) {
      continue;
    }
    free.push_back({{effect, static_cast<int>(p)},
                    declaration.name + "@" + use.at + ":" + parameter.name,
                    effects::unit_at(parameter.unit, angular),
                    parameter.scale,
                    parameter.lower,
                    parameter.upper,
                    typical[p]});
    effects::Values gone = typical;
    gone[p] = parameter.null_value;
    const bool is_bound = parameter.null_value == parameter.lower || parameter.null_value == parameter.upper;
    free.back().leaves_at_bound = is_bound && use.law->state_count() > 0 && use.law->is_null(gone.data());
  }
  return free;
}

std::vector<FreeParameter> searched_parameters_of(const model::Model& model, const Candidate& candidate,
                                                  int effect) {
  const model::EffectUse& use = model.effects[static_cast<std::size_t>(effect)];
  const bool angular = model.place_is_angular(candidate.place, candidate.at);
  constexpr double kReach = 4.0;  // half ranges of the motion
  const effects::Scales& scales = candidate.scales;
  std::vector<FreeParameter> free = free_parameters_of(use, effect, scales, angular);
  const std::vector<int>& none = candidate.without_effect;
  const auto has_none = [&](const FreeParameter& one) {
    return std::find(none.begin(), none.end(), one.id.parameter) != none.end();
  };
  free.erase(std::remove_if(free.begin(), free.end(), has_none), free.end());
  for (FreeParameter& one : free) {
    keep_physical(model, use, one);
    keep_physical(scales, use, one);
    if (effects::is_rest(use.law->declaration().parameters[static_cast<std::size_t>(one.id.parameter)])) {
      one.lower = std::max(one.lower, scales.center - kReach * scales.position);
      one.upper = std::min(one.upper, scales.center + kReach * scales.position);
    }
    // A drive that stretches under its usual force by more than it moves transmits nothing any more.
    if (one.scale == effects::Scale::reciprocal) {
      one.lower = std::max(one.lower, use.law->typical(scales)[static_cast<std::size_t>(one.id.parameter)]);
    }
  }
  return free;
}

Eigen::VectorXd values_of(const model::Model& model, const std::vector<FreeParameter>& parameters) {
  Eigen::VectorXd theta(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const model::ParameterId id = parameters[p].id;
    theta[static_cast<Eigen::Index>(p)] = model.effects[static_cast<std::size_t>(id.effect)]
                                              .values[static_cast<std::size_t>(id.parameter)]
                                              .value;
  }
  return theta;
}

model::Model with_values(model::Model model, const std::vector<FreeParameter>& parameters,
                         const Eigen::VectorXd& theta) {
  const model::Model before = model;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    std::vector<model::ParameterId> ids{parameters[p].id};
    ids.insert(ids.end(), parameters[p].also.begin(), parameters[p].also.end());
    for (const model::ParameterId& id : ids) {
      model.effects[static_cast<std::size_t>(id.effect)]
          .values[static_cast<std::size_t>(id.parameter)]
          .value = theta[static_cast<Eigen::Index>(p)];
    }
  }
  for (const FreeParameter& parameter : parameters) {
    keep_states(before, parameter, model);
  }
  return model;
}

}  // namespace plumbline::validation
