#include "validation/identify/diagnose/inertial_places.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulator/model/inertial_sensors.h"

namespace plumbline::validation {
namespace {

using Axes = std::array<const Measured*, 3>;

/// Its recorded components, null where one was not recorded.
Axes axes_of(const model::Model& model, const Trial& trial, const std::string& sensor) {
  Axes axes{};
  for (const Measured& channel : trial.measured) {
    const model::Sensor* known = model.find_sensor(channel.sensor);
    if (known != nullptr && model::is_inertial(*known) && known->group == sensor) {
      axes.at(static_cast<std::size_t>(known->axis)) = &channel;
    }
  }
  return axes;
}

double floor_of(const model::Sensor& sensor, const Measured& channel) {
  model::Sensor recorded = sensor;
  recorded.resolution = channel.resolution.value_or(sensor.resolution);
  recorded.noise = channel.noise.value_or(sensor.noise);
  return recorded.floor();
}

/// By how many floors the readings change at most, root mean square of a component over a trial.
double change_in_floors(const model::Sensor& sensor, const Axes& axes,
                        const effects::InertialReading& reading) {
  const Eigen::Matrix3d by = reading.gain - Eigen::Matrix3d::Identity();
  double largest = 0.0;
  for (std::size_t row = 0; row < axes.size(); ++row) {
    if (axes.at(row) == nullptr) {
      continue;
    }
    Eigen::VectorXd change =
        Eigen::VectorXd::Constant(axes.at(row)->values.size(), reading.bias[static_cast<Eigen::Index>(row)]);
    for (std::size_t column = 0; column < axes.size(); ++column) {
      if (axes.at(column) != nullptr) {
        change +=
            by(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) * axes.at(column)->values;
      }
    }
    const double rms = change.norm() / std::sqrt(static_cast<double>(change.size()));
    largest = std::max(largest, rms / floor_of(sensor, *axes.at(row)));
  }
  return largest;
}

bool is_any(const Axes& axes) {
  return std::any_of(axes.begin(), axes.end(), [](const Measured* one) { return one != nullptr; });
}

}  // namespace

bool is_recorded_inertial(const model::Model& model, const std::vector<Trial>& trials,
                          const std::string& sensor) {
  return std::any_of(trials.begin(), trials.end(),
                     [&](const Trial& trial) { return is_any(axes_of(model, trial, sensor)); });
}

double largest_reading(const model::Model& model, const std::vector<Trial>& trials,
                       const std::string& sensor) {
  double largest = model::find_inertial(model, sensor)->floor();
  for (const Trial& trial : trials) {
    for (const Measured* axis : axes_of(model, trial, sensor)) {
      if (axis != nullptr && trial.role == Role::train) {
        largest = std::max(largest, axis->values.cwiseAbs().maxCoeff());
      }
    }
  }
  return largest;
}

std::vector<int> unseen_parameters(const model::Model& model, const std::vector<Trial>& trials,
                                   const Candidate& candidate) {
  constexpr double kSeen = 2.0;  // floors; noise alone is one
  const auto& law = dynamic_cast<const effects::InertialSensorLaw&>(*candidate.law);
  const model::Sensor& sensor = *model::find_inertial(model, candidate.at);
  const effects::Values typical = law.typical(candidate.scales);
  std::vector<int> unseen;
  for (std::size_t p = 0; p < typical.size(); ++p) {
    effects::Values moved = law.null_values();
    moved[p] += typical[p];
    const effects::InertialReading reading = law.inertial_reading(moved.data());
    const bool is_seen = std::any_of(trials.begin(), trials.end(), [&](const Trial& trial) {
      return trial.role == Role::train &&
             change_in_floors(sensor, axes_of(model, trial, candidate.at), reading) > kSeen;
    });
    if (!is_seen) {
      unseen.push_back(static_cast<int>(p));
    }
  }
  return unseen;
}

}  // namespace plumbline::validation
