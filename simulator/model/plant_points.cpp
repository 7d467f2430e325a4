// What is measured at points of links, and how it changes with the state.
#include <algorithm>

#include "simulator/model/inertial_sensors.h"
#include "simulator/model/plant_readings.h"
#include "simulator/model/point_sensors.h"

namespace plumbline::model {
namespace {

/// From slopes of what inertial sensors truly feel to those of what they read, sensors x anything.
template <typename Chains, typename Values>
void read_slopes(const Chains& chains, const Values& values, Eigen::MatrixXd& slopes) {
  for (std::size_t s = 0; s < chains.size(); ++s) {
    if (has_inertial(chains[s])) {
      auto three = slopes.middleRows<3>(static_cast<Eigen::Index>(s));
      three = (inertial_reading(chains[s], values).gain * three).eval();
    }
  }
}

}  // namespace

int PlantReadings::tree_body_of_sensor(int sensor) const {
  return bodies_.mechanism().tree_body(model_.sensors[static_cast<std::size_t>(sensor)].body);
}

void PlantReadings::place_point_sensor(int sensor) {
  output_map_.row(sensor).setZero();
  output_offset_[sensor] = 0.0;
  points_.push_back({sensor, tree_body_of_sensor(sensor)});
}

Eigen::VectorXd PlantReadings::accelerations_at(const double* x, const double* command) {
  Eigen::VectorXd acceleration;
  if (model_.has(PointReading::accelerometer)) {
    const std::vector<double> none(static_cast<std::size_t>(plant_.motors()), 0.0);
    Eigen::VectorXd xdot(plant_.states());
    plant_.rate(x, command != nullptr ? command : none.data(), xdot.data());
    acceleration = S_tree_ * xdot.segment(nz_, nz_);
  }
  return acceleration;
}

// One after the other: the three components of a sensor share what is computed for the first.
void PlantReadings::read_points(const double* x, const Eigen::VectorXd& acceleration,
                                Eigen::VectorXd& readings) {
  bodies_.rigid_at(x);
  Eigen::Vector3d whole = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Sensor& sensor = model_.sensors[static_cast<std::size_t>(points_[i].sensor)];
    if (i == 0 || sensor.axis == 0) {
      whole = point_reading(bodies_.tree(), points_[i].body, sensor, acceleration);
    }
    readings[static_cast<Eigen::Index>(i)] = whole[sensor.axis];
  }
}

void PlantReadings::point_outputs(const double* x, const double* command, double* y) {
  if (points_.empty()) {
    return;
  }
  Eigen::VectorXd readings(static_cast<Eigen::Index>(points_.size()));
  read_points(x, accelerations_at(x, command), readings);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    y[points_[i].sensor] = readings[static_cast<Eigen::Index>(i)];
  }
  for (std::size_t s = 0; s < sensor_effects_.size(); ++s) {
    if (has_inertial(sensor_effects_[s])) {
      const effects::InertialReading reads =
          inertial_reading(sensor_effects_[s], [&](const SensorSlot& slot) { return values(slot.effect); });
      Eigen::Map<Eigen::Vector3d> three(y + s);
      three = (reads.gain * three + reads.bias).eval();
    }
  }
}

Eigen::MatrixXd PlantReadings::acceleration_map(const double* x) {
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(sensors(), nz_);
  bodies_.rigid_at(x);
  for (const PointSlot& slot : points_) {
    const Sensor& sensor = model_.sensors[static_cast<std::size_t>(slot.sensor)];
    if (sensor.reading == PointReading::accelerometer) {
      map.row(slot.sensor) = point_rows(bodies_.tree(), slot.body, sensor).row(sensor.axis) * S_tree_;
    }
  }
  read_slopes(
      sensor_effects_, [&](const SensorSlot& slot) { return values(slot.effect); }, map);
  return map;
}

void PlantReadings::point_jacobian(const double* x, const double* command, Eigen::MatrixXd& C) {
  if (points_.empty()) {
    return;
  }
  bodies_.rigid_at(x);
  for (const PointSlot& slot : points_) {
    const Sensor& sensor = model_.sensors[static_cast<std::size_t>(slot.sensor)];
    if (sensor.reading != PointReading::accelerometer) {
      C.row(slot.sensor).segment(sensor.shows_pose() ? 0 : nz_, nz_) =
          point_rows(bodies_.tree(), slot.body, sensor).row(sensor.axis) * S_tree_;
    }
  }
  if (model_.has(PointReading::accelerometer) || model_.has(PointReading::gyroscope)) {
    feel_points(accelerations_at(x, command), C);
    read_slopes(
        sensor_effects_, [&](const SensorSlot& slot) { return values(slot.effect); }, C);
  }
}

// Where rate() or rigid_at() has left the tree.
void PlantReadings::feel_points(Eigen::VectorXd acceleration, Eigen::MatrixXd& C) {
  if (acceleration.size() == 0) {
    acceleration.setZero(n_tree_);  // gyroscopes do not ask for it
  }
  tree_slopes_.set(bodies_.tree(), acceleration);
  TreeSlopes::Felt felt;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const PointSlot& slot = points_[i];
    const Sensor& sensor = model_.sensors[static_cast<std::size_t>(slot.sensor)];
    if (!is_inertial(sensor)) {
      continue;  // point_rows() tells how the others change with positions
    }
    if (i == 0 || sensor.axis == 0) {
      tree_slopes_.felt_at(slot.body, bodies_.tree().station(slot.body, sensor.point), felt);
    }
    const Eigen::RowVector3d along =
        (bodies_.tree().rotation(slot.body) * sensor.mounting).col(sensor.axis).transpose();
    if (sensor.reading == PointReading::gyroscope) {
      C.row(slot.sensor).head(nz_) = along * felt.turn_by_position * S_tree_;
    } else {
      C.row(slot.sensor).head(nz_) = along * felt.pull_by_position * S_tree_;
      C.row(slot.sensor).segment(nz_, nz_) = along * felt.pull_by_velocity * S_tree_;
    }
  }
}

// An accelerometer feels where gravity points, beside what that does to the motion.
void PlantReadings::tilt_tangent(const double* x, const std::vector<ParameterId>& parameters,
                                 const Eigen::VectorXd& steps, Eigen::MatrixXd& D) {
  if (!model_.has(PointReading::accelerometer)) {
    return;
  }
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const effects::Law& law = *model_.effects[static_cast<std::size_t>(parameters[k].effect)].law;
    const bool structure = dynamic_cast<const effects::StructureLaw*>(&law) != nullptr;
    if (!structure || !law.sits_at(effects::Place::world)) {
      continue;
    }
    const auto column = static_cast<Eigen::Index>(k);
    const BodyVariant& variant = tangent_.variant_of(parameters[k], steps[column]);
    bodies_.rigid_at(x);
    const Eigen::Vector3d change =
        (variant.structure.mechanism->tree().gravity() - bodies_.tree().gravity()) / variant.step;
    for (const PointSlot& slot : points_) {
      const Sensor& sensor = model_.sensors[static_cast<std::size_t>(slot.sensor)];
      if (sensor.reading == PointReading::accelerometer) {
        D(slot.sensor, column) -=
            (bodies_.tree().rotation(slot.body) * sensor.mounting).col(sensor.axis).dot(change);
      }
    }
  }
  read_slopes(
      sensor_effects_, [&](const SensorSlot& slot) { return values(slot.effect); }, D);
}

}  // namespace plumbline::model
