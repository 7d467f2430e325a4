#include "simulator/model/inertial_tangent.h"

#include <Eigen/LU>
#include <algorithm>
#include <string>

#include "simulator/model/inertial_sensors.h"

namespace plumbline::model {
namespace {

/// One of the model's effects at an inertial sensor, with the values that a plant has.
struct InertialUse {
  const effects::Law* law = nullptr;
  effects::Values values;
  int effect = 0;
};

bool is_inertial_law(const effects::Law& law) {
  return dynamic_cast<const effects::InertialSensorLaw*>(&law) != nullptr;
}

effects::Values values_in(const Plant& plant, int effect) {
  effects::Values values;
  const effects::Law& law = *plant.model().effects[static_cast<std::size_t>(effect)].law;
  for (int p = 0; p < law.parameter_count(); ++p) {
    values.push_back(plant.value({effect, p}));
  }
  return values;
}

std::vector<InertialUse> uses_at(const Plant& plant, const std::string& at) {
  std::vector<InertialUse> uses;
  for (std::size_t e = 0; e < plant.model().effects.size(); ++e) {
    const EffectUse& use = plant.model().effects[e];
    if (use.at == at && is_inertial_law(*use.law)) {
      uses.push_back({use.law.get(), values_in(plant, static_cast<int>(e)), static_cast<int>(e)});
    }
  }
  return uses;
}

}  // namespace

bool is_any_inertial(const Model& model, const std::vector<ParameterId>& parameters) {
  return std::any_of(parameters.begin(), parameters.end(), [&](const ParameterId& id) {
    return is_inertial_law(*model.effects[static_cast<std::size_t>(id.effect)].law);
  });
}

void add_inertial_tangent(const Plant& plant, const Eigen::VectorXd& readings,
                          const std::vector<ParameterId>& parameters, const Eigen::VectorXd& steps,
                          Eigen::MatrixXd& D) {
  const auto of = [](const InertialUse& use) { return use.values.data(); };
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const EffectUse& moving = plant.model().effects[static_cast<std::size_t>(parameters[k].effect)];
    if (!is_inertial_law(*moving.law)) {
      continue;
    }
    const int sensor = plant.model().sensor_index(find_inertial(plant.model(), moving.at)->name);
    std::vector<InertialUse> uses = uses_at(plant, moving.at);
    const effects::InertialReading here = inertial_reading(uses, of);
    for (InertialUse& use : uses) {
      if (use.effect == parameters[k].effect) {
        use.values[static_cast<std::size_t>(parameters[k].parameter)] += steps[static_cast<Eigen::Index>(k)];
      }
    }
    const effects::InertialReading there = inertial_reading(uses, of);
    const Eigen::Vector3d actual = here.gain.inverse() * (readings.segment<3>(sensor) - here.bias);
    D.block<3, 1>(sensor, static_cast<Eigen::Index>(k)) +=
        ((there.gain - here.gain) * actual + there.bias - here.bias) / steps[static_cast<Eigen::Index>(k)];
  }
}

}  // namespace plumbline::model
