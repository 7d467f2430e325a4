// What all motors of a plant hang on, over the plant's own slots and lines.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "simulator/effects/supply_law.h"

namespace plumbline::model {

/// The supplies at one motion. `values` gives a slot's parameters; each slot's law is a SupplyLaw; `lines`
/// are those of the motors, `velocities` those of the independent coordinates.
template <typename Slots, typename Lines, typename Values>
class Supplies {
 public:
  Supplies(const Slots& slots, const Lines& lines, Values values, const double* velocities)
      : slots_(slots), lines_(lines), values_(values), speeds_(static_cast<Eigen::Index>(lines.size())) {
    for (std::size_t m = 0; m < lines.size(); ++m) {
      double speed = 0.0;
      for (const auto& entry : lines[m].entries) {
        speed += entry.value * velocities[entry.index];
      }
      speeds_[static_cast<Eigen::Index>(m)] = speed;
    }
  }

  /// Share of these torques that is left to every motor.
  double share(const Eigen::VectorXd& torques) const { return share_at(torques, speeds_); }

  /// Generalised force of torques.
  Eigen::VectorXd force_of(const Eigen::VectorXd& torques) const {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(lines_.front().reduced.size());
    for (std::size_t m = 0; m < lines_.size(); ++m) {
      force += lines_[m].reduced * torques[static_cast<Eigen::Index>(m)];
    }
    return force;
  }

  /// d(share)/d(velocities of the independent coordinates).
  Eigen::RowVectorXd slope(const Eigen::VectorXd& torques) const {
    Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(lines_.front().reduced.size());
    Eigen::VectorXd moved = speeds_;
    for (std::size_t m = 0; m < lines_.size(); ++m) {
      const auto i = static_cast<Eigen::Index>(m);
      const double step = 1e-4 * (1.0 + std::abs(speeds_[i]));
      moved[i] = speeds_[i] + step;
      slope += (share_at(torques, moved) - share(torques)) / step * lines_[m].reduced.transpose();
      moved[i] = speeds_[i];
    }
    return slope;
  }

 private:
  double share_at(const Eigen::VectorXd& torques, const Eigen::VectorXd& speeds) const {
    double share = 1.0;
    for (const auto& slot : slots_) {
      const auto& law = static_cast<const effects::SupplyLaw&>(*slot.law);
      share *= law.share(torques.data(), speeds.data(), static_cast<int>(torques.size()), values_(slot));
    }
    return share;
  }

  const Slots& slots_;
  const Lines& lines_;
  Values values_;
  Eigen::VectorXd speeds_;
};

}  // namespace plumbline::model
