// A sensor of the model as one recording had it.
#include "simulator/trace/error.h"
#include "validation/trial/trial.h"

namespace plumbline::validation {
namespace {

void take_over(const Measured& measured, model::Sensor& sensor) {
  sensor.resolution = measured.resolution.value_or(sensor.resolution);
  sensor.noise = measured.noise.value_or(sensor.noise);
}

}  // namespace

model::Sensor sensor_of(const model::Model& model, const Measured& measured) {
  model::Sensor sensor = *model.find_sensor(measured.sensor);
  take_over(measured, sensor);
  return sensor;
}

model::Model as_recorded(const model::Model& model, const Trial& trial) {
  model::Model recorded = model;
  for (const Measured& measured : trial.measured) {
    const int index = model.sensor_index(measured.sensor);
    if (index >= 0) {
      take_over(measured, recorded.sensors[static_cast<std::size_t>(index)]);
    }
  }
  return recorded;
}

}  // namespace plumbline::validation
