#include "simulator/model/plant_readings.h"

#include <algorithm>

#include "simulator/model/inertial_sensors.h"
#include "simulator/model/late_reading.h"

namespace plumbline::model {

using Vector = Eigen::Map<const Eigen::VectorXd>;

PlantReadings::PlantReadings(PlantDynamics& plant, PlantTangent& tangent)
    : plant_(plant),
      tangent_(tangent),
      model_(plant.model()),
      bodies_(plant.bodies()),
      S_tree_(plant.map().S_tree()),
      n_tree_(plant.map().tree()),
      nz_(plant.positions()) {
  sensor_effects_.resize(model_.sensors.size());
  for (std::size_t e = 0; e < model_.effects.size(); ++e) {
    const EffectUse& use = model_.effects[e];
    const auto* law = dynamic_cast<const effects::SensorLaw*>(use.law.get());
    for (std::size_t s = 0; law != nullptr && s < model_.sensors.size(); ++s) {
      if (model_.sensors[s].name == use.at || sits_at_first(*law, use.at, model_.sensors[s])) {
        sensor_effects_[s].push_back({law, static_cast<int>(e)});
      }
    }
  }
  output_map_.resize(sensors(), nz_);
  output_offset_.resize(sensors());
  for (int s = 0; s < sensors(); ++s) {
    const Sensor& sensor = model_.sensors[static_cast<std::size_t>(s)];
    if (sensor.is_force_plate()) {
      output_map_.row(s).setZero();
      output_offset_[s] = 0.0;
      continue;
    }
    if (sensor.is_at_point()) {
      place_point_sensor(s);
      continue;
    }
    const LinearForm line = plant_.map().line_of(plant_.map().full_direction(sensor.measures));
    output_map_.row(s) = line.reduced.transpose();
    output_offset_[s] = sensor.rate ? sensor.offset : line.offset + sensor.offset;
  }
}

void PlantReadings::outputs(const double* x, double* y, const double* command) {
  for (int s = 0; s < sensors(); ++s) {
    const double* seen = model_.sensors[static_cast<std::size_t>(s)].rate ? x + nz_ : x;
    double reading = output_offset_[s];
    for (int i = 0; i < nz_; ++i) {
      reading += output_map_(s, i) * seen[i];
    }
    const std::vector<SensorSlot>& chain = sensor_effects_[static_cast<std::size_t>(s)];
    if (!chain.empty()) {
      const double lag = lag_of(chain, [&](const SensorSlot& slot) { return values(slot.effect); });
      reading += plant_.losses().lost(s, x) - lag * output_map_.row(s).dot(Vector(x + nz_, nz_));
    }
    for (const SensorSlot& slot : chain) {
      reading = slot.law->reading(reading, values(slot.effect));
    }
    y[s] = reading;
  }
  plate_outputs(x, y);
  point_outputs(x, command, y);
}

// Force plates: the vertical forces of the ground on the feet that stand on them.
void PlantReadings::plate_outputs(const double* x, double* y) {
  if (!model_.has_force_plate()) {
    return;
  }
  const std::vector<Touch> feet = plant_.touches(x);
  for (int s = 0; s < sensors(); ++s) {
    const Sensor& plate = model_.sensors[static_cast<std::size_t>(s)];
    if (!plate.is_force_plate()) {
      continue;
    }
    y[s] = 0.0;
    for (const int foot : plate.feet) {
      y[s] += feet[static_cast<std::size_t>(foot)].force.z();
    }
  }
}

void PlantReadings::output_jacobian(const double* x, Eigen::MatrixXd& C, const double* command) {
  const SensorLosses& losses = plant_.losses();
  C.setZero(sensors(), losses.empty() ? 2 * nz_ : plant_.states());
  for (const LossSlot& slot : losses.slots()) {
    C(slot.sensor, slot.state) = 1.0;
  }
  for (int s = 0; s < sensors(); ++s) {
    const bool rate = model_.sensors[static_cast<std::size_t>(s)].rate;
    C.row(s).segment(rate ? nz_ : 0, nz_) = output_map_.row(s);
  }
  Eigen::VectorXd actual = output_map_ * Eigen::Map<const Eigen::VectorXd>(x, nz_) + output_offset_;
  for (int s = 0; s < sensors(); ++s) {
    const auto& chain = sensor_effects_[static_cast<std::size_t>(s)];
    if (chain.empty()) {
      continue;
    }
    const double lag = lag_of(chain, [&](const SensorSlot& slot) { return values(slot.effect); });
    C.row(s).segment(nz_, nz_) -= lag * output_map_.row(s);
    const double late = lag * output_map_.row(s).dot(Eigen::Map<const Eigen::VectorXd>(x + nz_, nz_));
    const double middle = actual[s] + losses.lost(s, x) - late;
    double plus = middle + 1e-6;
    double minus = middle - 1e-6;
    for (const SensorSlot& slot : chain) {
      plus = slot.law->reading(plus, values(slot.effect));
      minus = slot.law->reading(minus, values(slot.effect));
    }
    C.row(s) *= (plus - minus) / 2e-6;
  }
  point_jacobian(x, command, C);
}

void PlantReadings::output_tangent(const double* x, const std::vector<ParameterId>& parameters,
                                   const Eigen::VectorXd& steps, Eigen::MatrixXd& D) {
  D.setZero(sensors(), static_cast<Eigen::Index>(parameters.size()));
  for (int s = 0; s < sensors(); ++s) {
    const auto& chain = sensor_effects_[static_cast<std::size_t>(s)];
    if (chain.empty()) {
      continue;
    }
    const double actual = output_offset_[s] + plant_.losses().lost(s, x) +
                          output_map_.row(s).dot(Eigen::Map<const Eigen::VectorXd>(x, nz_));
    const double speed = output_map_.row(s).dot(Eigen::Map<const Eigen::VectorXd>(x + nz_, nz_));
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const bool here = std::any_of(chain.begin(), chain.end(), [&](const SensorSlot& slot) {
        return slot.effect == parameters[k].effect;
      });
      if (!here) {
        continue;
      }
      const auto read = [&](double change) {
        effects::Values moved = plant_.stored(parameters[k].effect);
        moved[static_cast<std::size_t>(parameters[k].parameter)] += change;
        const auto of = [&](const SensorSlot& slot) {
          return slot.effect == parameters[k].effect ? moved.data() : values(slot.effect);
        };
        double reading = actual - lag_of(chain, of) * speed;
        for (const SensorSlot& slot : chain) {
          reading = slot.law->reading(reading, of(slot));
        }
        return reading;
      };
      D(s, column) = (read(steps[column]) - read(0.0)) / steps[column];
    }
  }
  tilt_tangent(x, parameters, steps, D);
}

}  // namespace plumbline::model
