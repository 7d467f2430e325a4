// How a Plant's sensors change with its state and its parameters.
#include <algorithm>

#include "simulator/model/late_reading.h"
#include "simulator/model/plant.h"

namespace plumbline::model {

void Plant::output_jacobian(const double* x, Eigen::MatrixXd& C, const double* command) {
  C.setZero(sensors(), 2 * nz_);
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
    C.row(s).tail(nz_) -= lag * output_map_.row(s);
    const double late = lag * output_map_.row(s).dot(Eigen::Map<const Eigen::VectorXd>(x + nz_, nz_));
    double plus = actual[s] - late + 1e-6;
    double minus = actual[s] - late - 1e-6;
    for (const SensorSlot& slot : chain) {
      plus = slot.law->reading(plus, values(slot.effect));
      minus = slot.law->reading(minus, values(slot.effect));
    }
    C.row(s) *= (plus - minus) / 2e-6;
  }
  point_jacobian(x, command, C);
}

void Plant::output_tangent(const double* x, const std::vector<ParameterId>& parameters,
                           const Eigen::VectorXd& steps, Eigen::MatrixXd& D) {
  D.setZero(sensors(), static_cast<Eigen::Index>(parameters.size()));
  for (int s = 0; s < sensors(); ++s) {
    const auto& chain = sensor_effects_[static_cast<std::size_t>(s)];
    if (chain.empty()) {
      continue;
    }
    const double actual =
        output_offset_[s] + output_map_.row(s).dot(Eigen::Map<const Eigen::VectorXd>(x, nz_));
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
        effects::Values moved = values_[static_cast<std::size_t>(parameters[k].effect)];
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
