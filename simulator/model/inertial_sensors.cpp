#include "simulator/model/inertial_sensors.h"

#include <algorithm>

namespace plumbline::model {

bool is_inertial(const Sensor& sensor) {
  return sensor.reading == PointReading::gyroscope || sensor.reading == PointReading::accelerometer;
}

std::vector<std::string> inertial_sensors(const Model& model) {
  std::vector<std::string> names;
  for (const Sensor& sensor : model.sensors) {
    if (is_inertial(sensor) && sensor.axis == 0) {
      names.push_back(sensor.group);
    }
  }
  return names;
}

const Sensor* find_inertial(const Model& model, const std::string& name) {
  const auto found = std::find_if(model.sensors.begin(), model.sensors.end(), [&](const Sensor& one) {
    return is_inertial(one) && one.group == name && one.axis == 0;
  });
  return found == model.sensors.end() ? nullptr : &*found;
}

bool sits_at_first(const effects::Law& law, const std::string& at, const Sensor& sensor) {
  return dynamic_cast<const effects::InertialSensorLaw*>(&law) != nullptr && is_inertial(sensor) &&
         sensor.group == at && sensor.axis == 0;
}

}  // namespace plumbline::model
