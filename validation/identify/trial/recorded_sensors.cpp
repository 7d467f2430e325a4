// A sensor of the model as one recording had it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "validation/identify/trial/trial.h"

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
  recorded.effects.insert(recorded.effects.end(), trial.configuration.begin(), trial.configuration.end());
  return recorded;
}

SwitchRecord record_of(const model::ContactSwitch& contact, const std::string& column,
                       Eigen::VectorXd closed) {
  return {contact.name,       column,
          std::move(closed),  contact.closes_late,
          contact.opens_late, contact.lateness_uncertainty,
          contact.bounce};
}

Eigen::VectorXd read_late(const model::ContactSwitch& contact, const Eigen::VectorXd& closed, double period) {
  Eigen::VectorXd read = closed;
  for (Eigen::Index k = 1; k < closed.size(); ++k) {
    if (closed[k] != closed[k - 1]) {
      const double late = closed[k] > 0.0 ? contact.closes_late : contact.opens_late;
      const Eigen::Index from = std::clamp<Eigen::Index>(k + std::lround(late / period), 0, closed.size());
      read.segment(std::min(k, from), from - std::min(k, from)).setConstant(closed[k - 1]);
      read.tail(closed.size() - from).setConstant(closed[k]);
    }
  }
  return read;
}

}  // namespace plumbline::validation
