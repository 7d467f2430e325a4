// Gyroscopes and accelerometers of three axes as places of laws, and what their laws make of the truth.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "simulator/effects/inertial_sensor_law.h"
#include "simulator/model/model.h"

namespace plumbline::model {

/// Is it a component of a gyroscope or an accelerometer of three axes?
bool is_inertial(const Sensor& sensor);

/// Their names, without a component, in file order.
std::vector<std::string> inertial_sensors(const Model& model);

/// First component of the one of this name, or nullptr.
const Sensor* find_inertial(const Model& model, const std::string& name);

/// Does the law sit at this component: at its sensor, as the first one?
bool sits_at_first(const effects::Law& law, const std::string& at, const Sensor& sensor);

/// Is any of a sensor's laws one of an inertial sensor?
template <typename Slots>
bool has_inertial(const Slots& slots) {
  return std::any_of(slots.begin(), slots.end(), [](const auto& slot) {
    return dynamic_cast<const effects::InertialSensorLaw*>(slot.law) != nullptr;
  });
}

/// What all laws of a sensor make of the truth, over the plant's own slots: the law that comes first acts
/// first. `values` gives a slot's parameters.
template <typename Slots, typename Values>
effects::InertialReading inertial_reading(const Slots& slots, const Values& values) {
  effects::InertialReading all;
  for (const auto& slot : slots) {
    if (const auto* law = dynamic_cast<const effects::InertialSensorLaw*>(slot.law)) {
      const effects::InertialReading one = law->inertial_reading(values(slot));
      all.gain = (one.gain * all.gain).eval();
      all.bias = (one.gain * all.bias + one.bias).eval();
    }
  }
  return all;
}

}  // namespace plumbline::model
