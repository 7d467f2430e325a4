#include "simulator/model/sensor_losses.h"

#include <algorithm>
#include <cmath>

namespace plumbline::model {

void SensorLosses::take(int& next_state) {
  for (std::size_t e = 0; e < model_.effects.size(); ++e) {
    const EffectUse& use = model_.effects[e];
    const auto* law = dynamic_cast<const effects::LosingSensorLaw*>(use.law.get());
    const int sensor = law == nullptr ? -1 : model_.sensor_index(use.at);
    if (sensor < 0 || law->is_null(values_[e].data())) {
      continue;
    }
    const Sensor& of = model_.sensors[static_cast<std::size_t>(sensor)];
    slots_.push_back(
        {law, static_cast<int>(e), sensor, next_state, map_.line_of(map_.full_direction(of.measures))});
    next_state += law->state_count();
  }
}

double SensorLosses::speed(const LossSlot& slot, const double* x) const {
  double speed = 0.0;
  for (const LinearForm::Entry& entry : slot.line.entries) {
    speed += entry.value * x[map_.independent() + entry.index];
  }
  return speed;
}

// Half of what the speed changes by over a sample.
double SensorLosses::half_change(const LossSlot& slot, const double* change) const {
  return change == nullptr ? 0.0 : 0.5 * speed(slot, change);
}

double SensorLosses::lost(int sensor, const double* x) const {
  double lost = 0.0;
  for (const LossSlot& slot : slots_) {
    lost += slot.sensor == sensor ? x[slot.state] : 0.0;
  }
  return lost;
}

void SensorLosses::write_rates(const double* x, double* xdot) const {
  for (const LossSlot& slot : slots_) {
    xdot[slot.state] = slot.law->loss_rate(speed(slot, x), values(slot));
  }
}

// A difference as wide as the speed's change: the limit may lie within the sample.
// A writable view is passed by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void SensorLosses::add_slopes(const double* x, const double* change, Eigen::Ref<Eigen::MatrixXd> A) const {
  for (const LossSlot& slot : slots_) {
    const double v = speed(slot, x);
    const double dv = std::max(1e-6 * (1.0 + std::abs(v)), std::abs(half_change(slot, change)));
    const double* p = values(slot);
    const double slope = (slot.law->loss_rate(v + dv, p) - slot.law->loss_rate(v - dv, p)) / (2.0 * dv);
    for (const LinearForm::Entry& entry : slot.line.entries) {
      A(slot.state, map_.independent() + entry.index) += slope * entry.value;
    }
  }
}

// In parts of the sample, for the same reason.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void SensorLosses::add_parameter_slopes(const double* x, const double* change, ParameterId id, double step,
                                        Eigen::Ref<Eigen::VectorXd> column) const {
  constexpr int kParts = 6;
  for (const LossSlot& slot : slots_) {
    if (slot.effect != id.effect) {
      continue;
    }
    effects::Values moved = values_[static_cast<std::size_t>(slot.effect)];
    moved[static_cast<std::size_t>(id.parameter)] += step;
    for (int i = 0; i < kParts; ++i) {
      const double share = (2.0 * i + 1.0) / kParts - 1.0;
      const double v = speed(slot, x) + share * half_change(slot, change);
      column[slot.state] +=
          (slot.law->loss_rate(v, moved.data()) - slot.law->loss_rate(v, values(slot))) / (step * kParts);
    }
  }
}

// The reading's rate is the true one and what is lost of it, r = v + loss_rate(v): by fixed-point steps from
// v = r. Where a large share is lost at once two true rates show the same, from (1 - share) limit to the
// limit; this finds the one at which less is lost. What is carried is right to a floor up to 3 % on the leg
// bench, and 24 floors of 775 off at 10 % (encoder of mLA, 2 s).
double SensorLosses::true_rate(int sensor, double reading_rate) const {
  constexpr int kSteps = 30;
  double rate = reading_rate;
  for (int i = 0; i < kSteps; ++i) {
    double next = reading_rate;
    for (const LossSlot& slot : slots_) {
      next -= slot.sensor == sensor ? slot.law->loss_rate(rate, values(slot)) : 0.0;
    }
    if (next == rate) {
      break;
    }
    rate = next;
  }
  return rate;
}

void SensorLosses::carry(int sensor, const Eigen::VectorXd& rates, double h, double* x) const {
  for (const double reading_rate : rates) {
    const double rate = true_rate(sensor, reading_rate);
    for (const LossSlot& slot : slots_) {
      if (slot.sensor == sensor) {
        x[slot.state] += h * slot.law->loss_rate(rate, values(slot));
      }
    }
  }
}

}  // namespace plumbline::model
