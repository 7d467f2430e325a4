#include "simulator/run/sensors.h"

#include "simulator/sensing/encoder.h"

namespace plumbline::run {

Sensors::Sensors(const model::Model& model, const SensorOptions& options)
    : model_(model), options_(options), random_(options.seed) {}

void Sensors::read(const Eigen::VectorXd& outputs, const std::vector<model::Touch>& touches, Sensed& sensed) {
  const auto sensors = static_cast<Eigen::Index>(model_.sensors.size());
  sensed.readings.resize(sensors);
  sensed.counts.resize(sensors);
  for (Eigen::Index s = 0; s < sensors; ++s) {
    const model::Sensor& sensor = model_.sensors[static_cast<std::size_t>(s)];
    double value = sensing::with_noise(outputs[s], options_.noise ? sensor.noise : 0.0, random_);
    // What a port of counts sees of an exact position is a count with its fraction.
    sensed.counts[s] = sensor.resolution > 0.0 ? value / sensor.resolution : 0.0;
    if (options_.quantise && sensor.resolution > 0.0) {
      const sensing::Encoder encoder{sensor.resolution, 1.0, 0.0};
      const std::int64_t counts = encoder.counts(value);
      value = encoder.position(counts);
      sensed.counts[s] = static_cast<double>(counts);
    }
    sensed.readings[s] = value;
  }
  sensed.feet.resize(static_cast<Eigen::Index>(touches.size()));
  for (std::size_t f = 0; f < touches.size(); ++f) {
    sensed.feet[static_cast<Eigen::Index>(f)] = touches[f].depth > 0.0 ? 1.0 : 0.0;
  }
  sensed.switches.resize(static_cast<Eigen::Index>(model_.switches.size()));
  for (std::size_t k = 0; k < model_.switches.size(); ++k) {
    // Closed: its foot is in the ground and, where the switch has a threshold, pressed by more.
    const model::ContactSwitch& one = model_.switches[k];
    const bool presses =
        one.threshold == 0.0 || touches[static_cast<std::size_t>(one.foot)].force.z() > one.threshold;
    sensed.switches[static_cast<Eigen::Index>(k)] = presses ? sensed.feet[one.foot] : 0.0;
  }
}

}  // namespace plumbline::run
