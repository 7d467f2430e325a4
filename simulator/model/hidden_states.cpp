#include "simulator/model/hidden_states.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

#include "simulator/model/asked_torque.h"

namespace plumbline::model {

using Vector = Eigen::Map<const Eigen::VectorXd>;

namespace {

/// One step of the exponential Euler method of one state s, `rate_of(s, rate)` its rate.
template <typename RateOf>
void step_state(const RateOf& rate_of, double h, double* s) {
  const double step = 1e-6 * (1.0 + std::abs(*s));
  const double moved = *s + step;
  double rate = 0.0;
  double other = 0.0;
  rate_of(s, &rate);
  rate_of(&moved, &other);
  const double reach = h * (other - rate) / step;
  *s += h * rate * (std::abs(reach) > 1e-8 ? std::expm1(reach) / reach : 1.0);
}

/// The same of `count` states that act on each other, a mass on a spring, a loop of second order: with their
/// Jacobian J and rate r the upper right corner of exp(h [J r; 0 0]), exact for linear laws however fast they
/// are against the step (Hochbruck and Ostermann, Acta Numerica 19 (2010) 209-286).
/// Of two states nothing is allocated: this is done for every sample before a window.
template <int Count, typename RateOf>
void step_coupled(const RateOf& rate_of, double h, int count, double* s) {
  constexpr int kSize = Count == Eigen::Dynamic ? Eigen::Dynamic : Count + 1;
  const FewStates before = Vector(s, count);
  FewStates moved = before;
  FewStates rate(count);
  FewStates other(count);
  rate_of(before.data(), rate.data());
  Eigen::Matrix<double, kSize, kSize> A(count + 1, count + 1);
  A.setZero();
  A.topRightCorner(count, 1) = h * rate;
  for (int k = 0; k < count; ++k) {
    const double step = 1e-6 * (1.0 + std::abs(before[k]));
    moved[k] += step;
    rate_of(moved.data(), other.data());
    moved[k] = before[k];
    A.col(k).head(count) = h / step * (other - rate);
  }
  const Eigen::Matrix<double, kSize, kSize> grown = A.exp();
  Eigen::Map<Eigen::VectorXd>(s, count) += grown.topRightCorner(count, 1);
}

template <typename RateOf>
void step_states(const RateOf& rate_of, double h, int count, double* s) {
  if (count == 1) {
    step_state(rate_of, h, s);
  } else if (count == 2) {
    step_coupled<2>(rate_of, h, count, s);
  } else {
    step_coupled<Eigen::Dynamic>(rate_of, h, count, s);
  }
}

}  // namespace

std::vector<int> carried_states(const PlantDynamics& plant) {
  std::vector<int> indices;
  const auto add = [&](const effects::Law& law, int state) {
    for (int k = 0; state >= 0 && k < law.state_count(); ++k) {
      indices.push_back(state + k);
    }
  };
  for (const ForceSlot& slot : plant.forces()) {
    add(*slot.law, slot.state);
  }
  for (const std::vector<ActuatorSlot>& chain : plant.actuators()) {
    for (const ActuatorSlot& slot : chain) {
      add(*slot.law, slot.state);
    }
  }
  for (const LossSlot& slot : plant.losses().slots()) {
    add(*slot.law, slot.state);
  }
  return indices;
}

// What comes before a lag in a motor's chain is what the lag follows.
std::vector<int> carried_state_effects(const PlantDynamics& plant) {
  std::vector<int> effects;
  for (const ForceSlot& slot : plant.forces()) {
    if (slot.state >= 0) {
      effects.push_back(slot.effect);
    }
  }
  for (const std::vector<ActuatorSlot>& chain : plant.actuators()) {
    const auto last =
        std::find_if(chain.rbegin(), chain.rend(), [](const auto& one) { return one.state >= 0; });
    std::for_each(last, chain.rend(), [&](const ActuatorSlot& slot) { effects.push_back(slot.effect); });
  }
  for (const LossSlot& slot : plant.losses().slots()) {
    effects.push_back(slot.effect);
  }
  return effects;
}

void carry_states(PlantDynamics& plant, const double* from, const double* to, const double* command, double h,
                  double* x) {
  for (const ForceSlot& slot : plant.forces()) {
    if (slot.state < 0 || !slot.active) {
      continue;
    }
    const auto along = [&](const double* at) {
      if (slot.rod >= 0) {
        plant.bodies().rigid_at(at);
        plant.aim_rods(at);
      }
      const Vector z(at, plant.positions());
      const Vector w(at + plant.positions(), plant.positions());
      return std::make_pair(slot.line.offset + slot.line.reduced.dot(z), slot.line.reduced.dot(w));
    };
    const auto [q0, v0] = along(from);
    const auto [q1, v1] = along(to);
    // What a winding follows. What a gear passes on needs the acceleration: no law with states feels it.
    const double load =
        slot.at_motor
            ? plant.actuator_chain(slot.motor, x,
                                   asked_torque(plant.model(), slot.motor, command[slot.motor]), nullptr)
            : 0.0;
    const effects::Motion middle{0.5 * (q0 + q1), 0.5 * (v0 + v1), load};
    step_states([&](const double* s,
                    double* rate) { slot.law->state_rate(middle, s, plant.values(slot.effect), rate); },
                h, slot.law->state_count(), x + slot.state);
  }
  for (int m = 0; m < plant.motors(); ++m) {
    double torque = asked_torque(plant.model(), m, command[m]);
    for (const ActuatorSlot& slot : plant.actuators()[static_cast<std::size_t>(m)]) {
      if (slot.state >= 0) {
        step_states([&](const double* s,
                        double* rate) { slot.law->state_rate(torque, s, plant.values(slot.effect), rate); },
                    h, slot.law->state_count(), x + slot.state);
      }
      if (slot.state >= 0 || slot.law->state_count() == 0) {
        torque =
            slot.law->torque(torque, slot.state >= 0 ? x + slot.state : nullptr, plant.values(slot.effect));
      }
    }
  }
}

// A force's states are 0, but for those that follow the load (a winding's torque): where they stay under it.
void settle(const PlantDynamics& plant, const double* command, double* x) {
  constexpr double kLong = 1e4;  // s
  const auto settle_force = [&](const ForceSlot& slot, double load) {
    const int count = slot.law->state_count();
    const auto rate_of = [&](double under, const double* s, double* rate) {
      slot.law->state_rate({0.0, 0.0, under}, s, plant.values(slot.effect), rate);
    };
    FewStates free(count);
    FewStates loaded(count);
    std::fill_n(x + slot.state, count, 0.0);
    rate_of(0.0, x + slot.state, free.data());
    rate_of(load, x + slot.state, loaded.data());
    if (free != loaded) {
      step_states([&](const double* s, double* rate) { rate_of(load, s, rate); }, kLong, count,
                  x + slot.state);
    }
  };
  for (int m = 0; m < plant.motors(); ++m) {
    double torque = asked_torque(plant.model(), m, command[m]);
    for (const ActuatorSlot& slot : plant.actuators()[static_cast<std::size_t>(m)]) {
      if (slot.state >= 0) {
        slot.law->settle(torque, plant.values(slot.effect), x + slot.state);
      }
      if (slot.state >= 0 || slot.law->state_count() == 0) {
        torque =
            slot.law->torque(torque, slot.state >= 0 ? x + slot.state : nullptr, plant.values(slot.effect));
      }
    }
    for (const ForceSlot& slot : plant.forces()) {
      if (slot.state >= 0 && slot.at_motor && slot.motor == m) {
        settle_force(slot, torque);
      }
    }
  }
  for (const ForceSlot& slot : plant.forces()) {
    if (slot.state >= 0 && !slot.at_motor) {
      std::fill_n(x + slot.state, slot.law->state_count(), 0.0);
    }
  }
  for (const LossSlot& slot : plant.losses().slots()) {
    x[slot.state] = 0.0;
  }
}

}  // namespace plumbline::model
