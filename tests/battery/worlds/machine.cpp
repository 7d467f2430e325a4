#include "tests/battery/worlds/machine.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace plumbline::battery::worlds {
namespace {

constexpr int kLoadIterations = 4;  // friction that depends on the load changes the load by its square

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

Vector unit(Eigen::Index size, Eigen::Index i) {
  Vector v = Vector::Zero(size);
  v[i] = 1.0;
  return v;
}

}  // namespace

Machine::Machine(const Rig& rig, const std::vector<std::string>& locked, const Vector& start)
    : rig_(rig), n_(rig.coordinates), start_(start) {
  const std::size_t motors = rig_.motors.size();
  lag_state_.assign(motors, -1);
  lag_.assign(motors, 0.0);
  bias_.assign(motors, 0.0);
  delay_.assign(motors, 0.0);
  build_coupling(locked, start);
  states_ = 2 * positions();
  add_effects();
}

// A motor is tied to its coordinate by its ratio, or, where its gear gives, moves by itself. A locked motor
// stays.
void Machine::build_coupling(const std::vector<std::string>& locked, const Vector& start) {
  const auto motors = static_cast<Eigen::Index>(rig_.motors.size());
  const Eigen::Index all = n_ + motors;
  std::vector<Vector> columns;
  offset_ = Vector::Zero(all);
  Matrix of_link = Matrix::Zero(all, n_);  // what moves with each coordinate of the links
  of_link.topRows(n_) = Matrix::Identity(n_, n_);
  std::vector<bool> held(static_cast<std::size_t>(n_), false);
  for (Eigen::Index i = 0; i < motors; ++i) {
    const Motor& motor = rig_.motors[static_cast<std::size_t>(i)];
    const bool is_soft = gives(rig_, motor);
    const bool is_locked = contains(locked, motor.name);
    if (is_locked) {
      offset_[n_ + i] = motor.ratio * start[motor.drives];
      if (!is_soft) {
        held[static_cast<std::size_t>(motor.drives)] = true;
        offset_[motor.drives] = start[motor.drives];
      }
    } else if (is_soft) {
      columns.push_back(unit(all, n_ + i));
    } else {
      of_link(n_ + i, motor.drives) = motor.ratio;
    }
  }
  for (Eigen::Index k = n_; k-- > 0;) {
    if (!held[static_cast<std::size_t>(k)]) {
      columns.insert(columns.begin(), of_link.col(k));
    }
  }
  S_ = Matrix::Zero(all, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    S_.col(static_cast<Eigen::Index>(c)) = columns[c];
  }
}

void Machine::add_effects() {
  const Eigen::Index all = offset_.size();
  for (const Hidden& effect : rig_.effects) {
    const Motor* motor = rig_.motor(effect.at);
    const auto index = motor == nullptr ? -1 : static_cast<int>(motor - rig_.motors.data());
    const auto i = static_cast<std::size_t>(std::max(index, 0));
    if (effect.effect == "actuator_lag") {
      lag_[i] = effect["time_constant"];
      lag_state_[i] = static_cast<int>(states_++);
      continue;
    }
    if (effect.effect == "torque_bias") {
      bias_[i] += effect["bias"];
      continue;
    }
    if (effect.effect == "command_delay") {
      delay_[i] += effect["delay"];
      continue;
    }
    Acting acting{effect, Vector::Zero(all), index, -1, is_compliance(effect)};
    if (index >= 0) {
      acting.row[n_ + index] = 1.0;
    } else {
      acting.row.head(n_) = rig_.place(effect.at)->row;
    }
    if (acting.compliance) {
      for (std::size_t m = 0; m < rig_.motors.size(); ++m) {
        if (rig_.place(effect.at)->row[rig_.motors[m].drives] == 1.0) {
          acting.motor = static_cast<int>(m);
          acting.row.setZero();
          acting.row[n_ + acting.motor] = 1.0;
          acting.row[rig_.motors[m].drives] = -rig_.motors[m].ratio;
        }
      }
    }
    if (has_state(effect)) {
      acting.state = static_cast<int>(states_++);
    }
    load_matters_ = load_matters_ || effect.effect == "load_friction" || effect.effect == "gear_friction";
    acting_.push_back(acting);
  }
}

Eigen::Index Machine::own_row(Eigen::Index column) const {
  for (Eigen::Index r = 0; r < S_.rows(); ++r) {
    if (S_(r, column) != 0.0) {
      return r;  // links' coordinates come first; a motor that moves by itself stands alone
    }
  }
  return 0;
}

State Machine::state_of(const Vector& full, const Vector& full_rate) const {
  State x = State::Zero(states_);
  for (Eigen::Index c = 0; c < positions(); ++c) {
    x[c] = full[own_row(c)];
    x[positions() + c] = full_rate[own_row(c)];
  }
  return x;
}

State Machine::start_state(const Vector& commands) const {
  Vector full = Vector::Zero(offset_.size());
  full.head(n_) = start_;
  for (std::size_t i = 0; i < rig_.motors.size(); ++i) {
    full[n_ + static_cast<Eigen::Index>(i)] = rig_.motors[i].ratio * start_[rig_.motors[i].drives];
  }
  State x = state_of(full, Vector::Zero(full.size()));
  for (std::size_t i = 0; i < rig_.motors.size(); ++i) {
    if (lag_state_[i] >= 0) {
      x[lag_state_[i]] = commands[static_cast<Eigen::Index>(i)];
    }
  }
  return x;
}

Vector Machine::forces(const Vector& commands, const State& x, const Vector& full, const Vector& full_rate,
                       const Vector& loads, Vector& passed, State& rate) const {
  passed = Vector::Zero(loads.size());
  Vector Q = Vector::Zero(full.size());
  for (std::size_t i = 0; i < rig_.motors.size(); ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    double u = commands[m];
    if (lag_state_[i] >= 0) {
      rate[lag_state_[i]] = (u - x[lag_state_[i]]) / lag_[i];
      u = x[lag_state_[i]];
    }
    Q[n_ + m] = rig_.motors[i].torque_per_unit * u + bias_[i];
  }
  for (const Acting& one : acting_) {
    const PlaceMotion motion{one.row.dot(full), one.row.dot(full_rate),
                             one.motor >= 0 && !one.compliance ? loads[one.motor] : 0.0};
    if (one.compliance) {
      const double on_motor = compliance_force(one.effect, motion.x, motion.v);
      Q += one.row * on_motor;
      passed[one.motor] -= on_motor;
      continue;
    }
    const double state = one.state >= 0 ? x[one.state] : 0.0;
    Q += one.row * force(one.effect, motion, state);
    if (one.state >= 0) {
      rate[one.state] = state_rate(one.effect, motion, state);
    }
  }
  for (const Ground& ground : rig_.grounds) {
    Q.head(n_) += ground.row * ground_force_of(rig_, ground, full, full_rate);
  }
  return Q;
}

void Machine::rates(const Vector& commands, const State& x, State& rate) const {
  const Eigen::Index nz = positions();
  const Vector full = S_ * x.head(nz) + offset_;
  const Vector full_rate = S_ * x.segment(nz, nz);
  Matrix M = Matrix::Zero(full.size(), full.size());
  Matrix links = Matrix::Zero(n_, n_);
  Vector bias = Vector::Zero(n_);
  rig_.equations(rig_, full.head(n_), full_rate.head(n_), links, bias);
  M.topLeftCorner(n_, n_) = links;
  for (std::size_t i = 0; i < rig_.motors.size(); ++i) {
    M(n_ + static_cast<Eigen::Index>(i), n_ + static_cast<Eigen::Index>(i)) = rig_.motors[i].inertia;
  }
  Vector loads = Vector::Zero(static_cast<Eigen::Index>(rig_.motors.size()));
  const Matrix Mz = S_.transpose() * M * S_;
  const auto lu = Mz.partialPivLu();
  rate.head(nz) = x.segment(nz, nz);
  for (int pass = 0; pass < (load_matters_ ? kLoadIterations : 1); ++pass) {
    Vector passed;
    Vector Q = forces(commands, x, full, full_rate, loads, passed, rate);
    const Vector motor_torques = Q.tail(loads.size()) + passed;
    Q.head(n_) -= bias;
    rate.segment(nz, nz) = lu.solve(S_.transpose() * Q);
    // What a gear passes on: the motor's torque less what turns the motor itself.
    const Vector motor_rates = (S_ * rate.segment(nz, nz)).tail(loads.size());
    for (std::size_t i = 0; i < rig_.motors.size(); ++i) {
      const auto m = static_cast<Eigen::Index>(i);
      loads[m] = motor_torques[m] - rig_.motors[i].inertia * motor_rates[m];
    }
  }
}

Motion Machine::run(State x, Eigen::Index first, Eigen::Index count, double period,
                    const Commander& command) const {
  Motion motion;
  const auto motors = static_cast<Eigen::Index>(rig_.motors.size());
  motion.positions.resize(offset_.size(), count);
  motion.rates.resize(offset_.size(), count);
  motion.commands.resize(motors, count);
  Vector now = Vector::Zero(motors);
  State k1(states_), k2(states_), k3(states_), k4(states_);
  for (Eigen::Index k = 0; k < count; ++k) {
    motion.positions.col(k) = positions_of(x);
    motion.rates.col(k) = rates_of(x);
    command(first + k, readings_of(rig_, motion.positions.col(k)), now);
    motion.commands.col(k) = now;
    // Where a delayed command changes within the sample.
    std::vector<double> ends{period};
    for (const double delay : delay_) {
      const double change = std::fmod(delay, period);
      if (change > 1e-12) {
        ends.push_back(change);
      }
    }
    std::sort(ends.begin(), ends.end());
    double from = 0.0;
    for (const double to : ends) {
      if (to - from < 1e-12) {
        continue;
      }
      Vector held = now;
      for (Eigen::Index m = 0; m < motors; ++m) {
        const double back = (0.5 * (from + to) - delay_[static_cast<std::size_t>(m)]) / period;
        const Eigen::Index then = k + static_cast<Eigen::Index>(std::floor(back));
        held[m] = motion.commands(m, std::max<Eigen::Index>(then, 0));
      }
      const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / kStep - 1e-9)));
      const double h = (to - from) / steps;
      for (int s = 0; s < steps; ++s) {
        rates(held, x, k1);
        rates(held, x + 0.5 * h * k1, k2);
        rates(held, x + 0.5 * h * k2, k3);
        rates(held, x + h * k3, k4);
        x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
      }
      from = to;
    }
  }
  return motion;
}

Vector Machine::positions_of(const State& x) const { return S_ * x.head(positions()) + offset_; }

Vector Machine::rates_of(const State& x) const { return S_ * x.segment(positions(), positions()); }

bool gives(const Rig& rig, const Motor& motor) {
  return std::any_of(rig.effects.begin(), rig.effects.end(), [&](const Hidden& e) {
    const Place* place = rig.place(e.at);
    return is_compliance(e) && place != nullptr && place->row[motor.drives] == 1.0 &&
           place->row.cwiseAbs().sum() == 1.0;
  });
}

Eigen::VectorXd readings_of(const Rig& rig, const Vector& full) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(rig.sensors.size()));
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    const Sensor& sensor = rig.sensors[s];
    double actual = 0.0;
    if (sensor.motor.empty()) {
      actual = sensor.row.dot(full.head(rig.coordinates));
    } else {
      for (std::size_t m = 0; m < rig.motors.size(); ++m) {
        actual = rig.motors[m].name == sensor.motor ? full[rig.coordinates + static_cast<Eigen::Index>(m)]
                                                    : actual;
      }
    }
    values[static_cast<Eigen::Index>(s)] = sensor.scale * actual + sensor.offset;
  }
  return values;
}

double depth_of(const Rig& rig, const Ground& ground, const Vector& full) {
  return ground.height - ground.constant - ground.row.dot(full.head(rig.coordinates));
}

double ground_force_of(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate) {
  const double deep = depth_of(rig, ground, full);
  if (deep <= 0.0) {
    return 0.0;
  }
  const double in = -ground.row.dot(full_rate.head(rig.coordinates));
  return std::pow(deep, ground.exponent) * std::max(0.0, ground.stiffness + ground.damping * in);
}

bool is_closed(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate) {
  return rig.switch_force > 0.0 ? ground_force_of(rig, ground, full, full_rate) > rig.switch_force
                                : depth_of(rig, ground, full) > 0.0;
}

}  // namespace plumbline::battery::worlds
