#include "validation/identify/predict/zero_errors.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "simulator/effects/catalogue.h"
#include "simulator/model/inertial_sensors.h"
#include "validation/identify/predict/foot_paths.h"
#include "validation/identify/predict/standing_feet.h"

namespace plumbline::validation {
namespace {

struct ZeroError {
  std::string sensor;
  double deviation = 0.0;
};

/// The law of a sensor's zero, and where it sits: an inertial sensor's three components share one.
struct ZeroLaw {
  std::string name, at;
};

ZeroLaw zero_law(const model::Model& model, const std::string& sensor) {
  const model::Sensor* known = model.find_sensor(sensor);
  const bool is_inertial = known != nullptr && model::is_inertial(*known);
  return is_inertial ? ZeroLaw{"imu_bias", known->group} : ZeroLaw{"encoder_offset", sensor};
}

bool is_use(const model::EffectUse& use, const ZeroLaw& law) {
  return use.law->declaration().name == law.name && use.at == law.at;
}

/// The effect of this law among those from `first` on, added at its null values where there is none.
model::EffectUse& use_of(const ZeroLaw& law, std::size_t first, model::Model& model) {
  for (std::size_t e = first; e < model.effects.size(); ++e) {
    if (is_use(model.effects[e], law)) {
      return model.effects[e];
    }
  }
  model::EffectUse use;
  use.law = effects::Catalogue::all().find(law.name);
  use.at = law.at;
  use.values.resize(static_cast<std::size_t>(use.law->parameter_count()));
  model.effects.push_back(std::move(use));
  return model.effects.back();
}

/// Of the sensors that have no such law yet.
std::vector<ZeroError> stated_in(const std::vector<Trial>& trials, const model::Model& model) {
  std::map<std::string, double> stated;
  for (const Trial& trial : trials) {
    for (const Measured& channel : trial.measured) {
      if (channel.offset_uncertainty > 0.0) {
        const auto known = stated.emplace(channel.sensor, channel.offset_uncertainty).first;
        known->second = std::min(known->second, channel.offset_uncertainty);
      }
    }
  }
  std::vector<ZeroError> errors;
  for (const auto& [sensor, deviation] : stated) {
    const bool is_known =
        std::any_of(model.effects.begin(), model.effects.end(),
                    [&, law = zero_law(model, sensor)](const auto& use) { return is_use(use, law); });
    if (!is_known) {
      errors.push_back({sensor, deviation});
    }
  }
  return errors;
}

model::Model with_offsets(model::Model model, const std::vector<ZeroError>& errors,
                          const Eigen::VectorXd& offsets) {
  const std::size_t first = model.effects.size();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const ZeroLaw law = zero_law(model, errors[i].sensor);
    const int axis = law.at == errors[i].sensor ? 0 : model.find_sensor(errors[i].sensor)->axis;
    model::Quantity& quantity = use_of(law, first, model).values[static_cast<std::size_t>(axis)];
    quantity.value = offsets[static_cast<Eigen::Index>(i)];
    quantity.uncertainty = errors[i].deviation;
    quantity.source = "offset_uncertainty of the trials";
  }
  return model;
}

/// Depths of each foot over the whole recorded motion, as the sensors say; feet x samples.
std::vector<std::vector<double>> depths(const model::Model& model, const Data& data) {
  std::vector<std::vector<double>> all(model.feet.size());
  for (const FootPath& path : foot_paths(model, data)) {
    const Eigen::VectorXd depths = path.places.row(3);
    all[path.foot].insert(all[path.foot].end(), depths.begin(), depths.end());
  }
  return all;
}

/// Has a foot stood: are many of its depths near the deepest?
bool has_stood(const std::vector<double>& depth) {
  constexpr double kNear =
      0.02;  // m: what zero errors of a few degrees do to a leg of a metre while it bends
  constexpr double kMany = 0.15;
  if (depth.empty() || !std::isfinite(depth.front())) {
    return false;
  }
  const double near = depth_reached(depth) - kNear;
  const auto many = std::count_if(depth.begin(), depth.end(), [&](double one) { return one > near; });
  return static_cast<double>(many) > kMany * static_cast<double>(depth.size());
}

/// Where the feet that have stood say that the offsets begin.
Eigen::VectorXd offsets_on_ground(const model::Model& model, const std::vector<ZeroError>& errors,
                                  const Data& data) {
  constexpr double kWell = 1e-3;  // m, how well a depth is known
  constexpr double kStep = 0.1;   // of an offset's deviation
  const auto count = static_cast<Eigen::Index>(errors.size());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(count);
  const std::vector<std::vector<double>> here = depths(with_offsets(model, errors, none), data);
  std::vector<std::size_t> feet;
  for (std::size_t f = 0; f < here.size(); ++f) {
    if (has_stood(here[f])) {
      feet.push_back(f);
    }
  }
  if (feet.empty()) {
    return Eigen::VectorXd::Zero(count);
  }
  const auto stood = static_cast<Eigen::Index>(feet.size());
  Eigen::MatrixXd J(stood, count);  // by offsets in units of their deviations
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd one =
        Eigen::VectorXd::Unit(count, i) * kStep * errors[static_cast<std::size_t>(i)].deviation;
    const std::vector<std::vector<double>> there = depths(with_offsets(model, errors, one), data);
    for (Eigen::Index f = 0; f < stood; ++f) {
      const std::size_t foot = feet[static_cast<std::size_t>(f)];
      J(f, i) = (depth_reached(there[foot]) - depth_reached(here[foot])) / kStep;
    }
  }
  Eigen::VectorXd missing(stood);
  for (Eigen::Index f = 0; f < stood; ++f) {
    missing[f] = kDepthAtRest - depth_reached(here[feet[static_cast<std::size_t>(f)]]);
  }
  const Eigen::MatrixXd known = J * J.transpose() + kWell * kWell * Eigen::MatrixXd::Identity(stood, stood);
  Eigen::VectorXd offsets = J.transpose() * known.ldlt().solve(missing);
  for (Eigen::Index i = 0; i < count; ++i) {
    offsets[i] *= errors[static_cast<std::size_t>(i)].deviation;
  }
  return offsets;
}

/// Released ratios' stretches at the first sample, as the sensors say.
Eigen::VectorXd stretches(const model::Model& model, const Data& data) {
  Predictor predictor(model, data.trials.front(), data.predict);
  return predictor.plant().stretch_map() * predictor.measured_positions().col(0);
}

bool shows_motor(const model::Model& model, const std::string& sensor) {
  const std::string& measured = model.sensors[static_cast<std::size_t>(model.sensor_index(sensor))].measures;
  return std::any_of(model.motors.begin(), model.motors.end(),
                     [&](const model::Motor& motor) { return motor.name == measured; });
}

/// The motors' offsets changed so that the stretches are those without any offset.
Eigen::VectorXd with_motors_zeroed(const model::Model& model, const std::vector<ZeroError>& errors,
                                   const Data& data, Eigen::VectorXd offsets) {
  const auto count = static_cast<Eigen::Index>(errors.size());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(count);
  const auto stretches_with = [&](const Eigen::VectorXd& some) {
    return stretches(with_offsets(model, errors, some), data);
  };
  const Eigen::VectorXd wanted = stretches_with(none);
  if (wanted.size() == 0) {
    return offsets;
  }
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(wanted.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    if (shows_motor(model, errors[static_cast<std::size_t>(i)].sensor)) {
      J.col(i) = stretches_with(Eigen::VectorXd::Unit(count, i)) - wanted;  // linear in the offsets
    }
  }
  return offsets + J.completeOrthogonalDecomposition().solve(wanted - stretches_with(offsets));
}

}  // namespace

model::Model with_zero_errors(const model::Model& model, const Data& data) {
  const std::vector<ZeroError> errors = stated_in(data.trials, model);
  if (errors.empty()) {
    return model;
  }
  const bool has_switches = std::any_of(data.trials.begin(), data.trials.end(),
                                        [](const Trial& trial) { return !trial.switches.empty(); });
  const bool is_in_air = model.feet.empty() || has_switches;
  const auto count = static_cast<Eigen::Index>(errors.size());
  if (is_in_air) {
    return with_offsets(model, errors, Eigen::VectorXd::Zero(count));
  }
  Eigen::VectorXd deviations(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    deviations[i] = errors[static_cast<std::size_t>(i)].deviation;
  }
  const Eigen::VectorXd offsets = offsets_of_standing_feet(
      data, [&](const Eigen::VectorXd& some) { return with_offsets(model, errors, some); }, deviations,
      offsets_on_ground(model, errors, data));
  return with_offsets(model, errors, with_motors_zeroed(model, errors, data, offsets));
}

}  // namespace plumbline::validation
