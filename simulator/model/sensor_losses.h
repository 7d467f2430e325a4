// What sensors have lost: hidden states that follow the motion and that the readings alone see.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/effects/losing_sensor_law.h"
#include "simulator/model/coordinate_map.h"
#include "simulator/model/model.h"
#include "simulator/model/plant_slots.h"
#include "simulator/model/plant_values.h"

namespace plumbline::model {

/// A law that loses something of what a sensor shows.
struct LossSlot {
  const effects::LosingSensorLaw* law = nullptr;
  int effect = 0;
  int sensor = 0;  ///< index in the model
  int state = -1;  ///< index in x of what was lost so far
  LinearForm line;
};

/// The losses of a model's sensors (only what shows a position is a place of such a law): d(lost)/dt =
/// loss_rate(v), v the true rate of what the sensor measures, and its reading is made of the true position
/// plus what was lost. Only laws that were not null when the model was built have a state: without one all
/// of this does nothing.
class SensorLosses {
 public:
  /// All three have to outlive the losses; `values` are those of the model's effects as they are now.
  SensorLosses(const Model& model, const CoordinateMap& map, const std::vector<effects::Values>& values)
      : model_(model), map_(map), values_(values) {}
  /// Finds the laws; states are counted from next_state on.
  void take(int& next_state);

  bool empty() const { return slots_.empty(); }
  const std::vector<LossSlot>& slots() const { return slots_; }
  /// What a sensor has lost in the state x, rad or m.
  double lost(int sensor, const double* x) const;

  void write_rates(const double* x, double* xdot) const;
  /// Adds d(rate)/dx. With the change of x over a motion means on the way (Plant::tangent); null: at x.
  void add_slopes(const double* x, const double* change, Eigen::Ref<Eigen::MatrixXd> A) const;
  /// Adds d(rate)/d(parameter) by a difference, as a mean over the motion.
  void add_parameter_slopes(const double* x, const double* change, ParameterId id, double step,
                            Eigen::Ref<Eigen::VectorXd> column) const;
  /// As Plant::carry_losses.
  void carry(int sensor, const Eigen::VectorXd& rates, double h, double* x) const;

 private:
  const double* values(const LossSlot& slot) const {
    return values_[static_cast<std::size_t>(slot.effect)].data();
  }
  double speed(const LossSlot& slot, const double* x) const;
  double half_change(const LossSlot& slot, const double* change) const;
  double true_rate(int sensor, double reading_rate) const;

  const Model& model_;
  const CoordinateMap& map_;
  const std::vector<effects::Values>& values_;
  std::vector<LossSlot> slots_;
};

}  // namespace plumbline::model
