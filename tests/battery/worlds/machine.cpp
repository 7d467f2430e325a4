#include "tests/battery/worlds/machine.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tests/battery/worlds/outside.h"

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
  drift_.assign(motors, 0.0);
  build_coupling(locked, start);
  states_ = 2 * positions();
  add_bristles();
  add_effects();
  add_light();
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
      offset_[n_ + i] = motor.at(start);
      if (!is_soft) {
        held[static_cast<std::size_t>(motor.drives)] = true;
        offset_[motor.drives] = start[motor.drives];
      }
    } else if (is_soft) {
      columns.push_back(unit(all, n_ + i));
    } else {
      of_link(n_ + i, motor.drives) = motor.ratio;
      if (motor.also >= 0) {
        of_link(n_ + i, motor.also) = motor.also_ratio;
      }
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
  free_ = S_.rows() == S_.cols() && S_.isIdentity(0.0);
}

void Machine::add_bristles() {
  for (const Ground& ground : rig_.grounds) {
    bristle_state_.push_back(has_bristles(ground) ? static_cast<int>(states_++) : -1);
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
    if (effect.effect == "current_loop") {
      loops_.push_back({i, static_cast<int>(states_), effect});
      states_ += 2;
      continue;
    }
    if (effect.effect == "winding") {
      circuits_.push_back({i, static_cast<int>(states_++), effect});
      continue;
    }
    if (add_outside(effect, i)) {
      continue;
    }
    if (effect.effect == "battery") {
      batteries_.push_back(effect);
      continue;
    }
    if (effect.effect == "thermal_motor") {
      warming_.push_back({i, static_cast<int>(states_), effect});
      states_ += 2;
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
    if (effect.effect == "bus_delay") {
      for (double& delay : delay_) {
        delay += effect["delay"];
      }
      continue;
    }
    if (effect.effect == "clock_drift") {
      delay_[i] += effect["offset"];
      drift_[i] += effect["drift"];
      continue;
    }
    if (is_of_drive(effect)) {
      windings_.emplace_back(i, effect);
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
          if (rig_.motors[m].also >= 0) {
            acting.row[rig_.motors[m].also] = -rig_.motors[m].also_ratio;
          }
        }
      }
    }
    acting.law = law_of(effect);
    if (states_of(effect) > 0) {
      acting.state = static_cast<int>(states_);
      states_ += states_of(effect);
    }
    load_matters_ = load_matters_ || effect.effect == "load_friction" || effect.effect == "gear_friction" ||
                    effect.effect == "gear_efficiency";
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

State Machine::state_of(const Vector& full, const Vector& full_rate, const Vector& bristles) const {
  State x = State::Zero(states_);
  x.segment(2 * positions(), bristles.size()) = bristles;
  for (Eigen::Index c = 0; c < positions(); ++c) {
    x[c] = full[own_row(c)];
    x[positions() + c] = full_rate[own_row(c)];
  }
  return x;
}

State Machine::start_state(const Vector& commands, const Vector& links_rate) const {
  Vector full = Vector::Zero(offset_.size());
  Vector full_rate = full;
  full.head(n_) = start_;
  if (links_rate.size() > 0) {
    full_rate.head(n_) = links_rate;
  }
  for (std::size_t i = 0; i < rig_.motors.size(); ++i) {
    full[n_ + static_cast<Eigen::Index>(i)] = rig_.motors[i].at(full);
    full_rate[n_ + static_cast<Eigen::Index>(i)] = rig_.motors[i].at(full_rate);
  }
  State x = state_of(full, full_rate);
  for (const Loop& loop : loops_) {
    const double command = commands[static_cast<Eigen::Index>(loop.motor)];
    x[loop.state] = loop.effect.effect == "slow_reversal" ? std::copysign(1.0, command) : command;
  }
  for (const Loop& one : circuits_) {
    x[one.state] = rig_.motors[one.motor].torque_per_unit * commands[static_cast<Eigen::Index>(one.motor)];
  }
  for (std::size_t i = 0; i < rig_.motors.size(); ++i) {
    if (lag_state_[i] >= 0) {
      x[lag_state_[i]] = commands[static_cast<Eigen::Index>(i)];
    }
  }
  return x;
}

double Machine::force_of(const Acting& one, const State& x, const Vector& full, const Vector& full_rate,
                         double load) const {
  const PlaceMotion motion{one.row.dot(full), one.row.dot(full_rate), load};
  if (one.compliance && one.state < 0) {
    return compliance_force(one.effect, motion.x, motion.v);
  }
  return one.law != nullptr ? one.law(one.effect, motion)
                            : force(one.effect, motion, one.state >= 0 ? x.data() + one.state : nullptr);
}

// A current on a spring w^2 and a damper 2 zeta w, pulled by what is asked for. States: current and its rate.
double Machine::through(const Loop& loop, double asked, const State& x, State& rate) {
  if (loop.effect.effect == "slow_reversal") {
    return turned_round(loop.effect, asked, x[loop.state], rate[loop.state]);
  }
  const double w = 1.0 / loop.effect["time_constant"];
  const double current = x[loop.state];
  rate[loop.state] = x[loop.state + 1];
  rate[loop.state + 1] =
      w * w * (asked - current) - 2.0 * loop.effect["damping_ratio"] * w * x[loop.state + 1];
  return current;
}

// Heat in joule, with 1 J/K of copper and 1/share J/K of iron; states: how much warmer than at first.
double Machine::warmed(const Loop& one, double asked, const State& x, State& rate) {
  const double copper = x[one.state];
  const double iron = x[one.state + 1];
  const double made = one.effect["heating"] * asked * asked * (1.0 + one.effect["copper"] * copper);
  const double crossing = (copper - iron) / one.effect["winding_time"];
  const double capacity = 1.0 / one.effect["share"];
  rate[one.state] = made - crossing;
  rate[one.state + 1] = (crossing - iron * capacity / one.effect["housing_time"]) / capacity;
  return asked * (1.0 - one.effect["magnet_sag"] * iron) / (1.0 + one.effect["copper_sag"] * copper);
}

// All motors hang on one battery.
void Machine::sag(const Vector& full_rate, Vector& Q) const {
  for (const Hidden& battery : batteries_) {
    std::vector<double> asked;
    std::vector<double> speeds;
    for (Eigen::Index m = n_; m < Q.size(); ++m) {
      asked.push_back(Q[m]);
      speeds.push_back(full_rate[m]);
    }
    Q.tail(Q.size() - n_) *= battery_voltage(battery, asked, speeds);
  }
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
    for (const Loop& loop : loops_) {
      u = loop.motor == i ? through(loop, u, x, rate) : u;
    }
    Q[n_ + m] = rig_.motors[i].torque_per_unit * u + bias_[i];
    for (const Loop& one : warming_) {
      Q[n_ + m] = one.motor == i ? warmed(one, Q[n_ + m], x, rate) : Q[n_ + m];
    }
    for (const auto& [motor, drive] : windings_) {
      Q[n_ + m] = motor == i ? delivered(drive, Q[n_ + m], full[n_ + m], full_rate[n_ + m]) : Q[n_ + m];
    }
    for (const Loop& one : circuits_) {
      if (one.motor == i) {
        rate[one.state] = current_rate(one.effect, Q[n_ + m], x[one.state], full_rate[n_ + m]);
        Q[n_ + m] = x[one.state];
      }
    }
  }
  sag(full_rate, Q);
  for (const Acting& one : acting_) {
    const double load = one.motor >= 0 && !one.compliance ? loads[one.motor] : 0.0;
    const double acts = force_of(one, x, full, full_rate, load);
    Q += one.row * acts;
    if (one.compliance) {
      passed[one.motor] -= acts;
    }
    if (one.state >= 0) {
      state_rates(one.effect, {one.row.dot(full), one.row.dot(full_rate), load}, x.data() + one.state,
                  rate.data() + one.state);
    }
  }
  for (std::size_t g = 0; g < rig_.grounds.size(); ++g) {
    const int state = bristle_state_[g];
    double unused = 0.0;
    press(rig_, rig_.grounds[g], full, full_rate, state >= 0 ? x[state] : 0.0, Q,
          state >= 0 ? rate[state] : unused);
  }
  return Q;
}

void Machine::rates(const Vector& commands, Creeping who, const State& x, State& rate) const {
  const Eigen::Index nz = positions();
  const Vector full = positions_of(x);
  Vector full_rate = rates_of(x);
  creep(who, x, full, full_rate);
  Matrix links = Matrix::Zero(n_, n_);
  Vector bias = Vector::Zero(n_);
  equations(x, full.head(n_), full_rate.head(n_), links, bias, rate);
  Vector motors(static_cast<Eigen::Index>(rig_.motors.size()));
  for (std::size_t i = 0; i < rig_.motors.size(); ++i) {
    motors[static_cast<Eigen::Index>(i)] = rig_.motors[i].inertia;
  }
  Eigen::LLT<Matrix> of_links;
  Eigen::PartialPivLU<Matrix> of_all;
  if (free_) {
    of_links.compute(links);
  } else {
    Matrix M = Matrix::Zero(full.size(), full.size());
    M.topLeftCorner(n_, n_) = links;
    M.diagonal().tail(motors.size()) = motors;
    of_all.compute(S_.transpose() * M * S_);
  }
  rate.head(nz) = x.segment(nz, nz);
  for (const Light& one : light_) {
    rate[one.column] = full_rate[one.row];
  }
  Vector loads = Vector::Zero(motors.size());
  for (int pass = 0; pass < (load_matters_ ? kLoadIterations : 1); ++pass) {
    Vector passed;
    Vector Q = forces(commands, x, full, full_rate, loads, passed, rate);
    const Vector motor_torques = Q.tail(motors.size()) + passed;
    Q.head(n_) -= bias;
    if (free_) {
      rate.segment(nz, n_) = of_links.solve(Q.head(n_));
      rate.segment(nz + n_, motors.size()) = Q.tail(motors.size()).cwiseQuotient(motors);
    } else {
      rate.segment(nz, nz) = of_all.solve(S_.transpose() * Q);
    }
    // What a gear passes on: the motor's torque less what turns the motor itself.
    const Vector motor_rates = (S_ * rate.segment(nz, nz)).tail(motors.size());
    loads = motor_torques - motors.cwiseProduct(motor_rates);
  }
  for (std::size_t l = 0; l < light_.size(); ++l) {
    if ((who >> l & 1U) != 0 && is_behind(light_[l], full)) {
      rate[nz + light_[l].column] = 0.0;  // settle() says what its speed is
    }
  }
}

Vector Machine::positions_of(const State& x) const {
  return free_ ? Vector(x.head(positions())) : Vector(S_ * x.head(positions()) + offset_);
}

Vector Machine::rates_of(const State& x) const {
  const Vector own = x.segment(positions(), positions());
  return free_ ? own : Vector(S_ * own);
}

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
    values[static_cast<Eigen::Index>(s)] = sensor.scale * actual + sensor.offset +
                                           sensor.amplitude * std::cos(sensor.waves * actual - sensor.phase) +
                                           bit_error(sensor.bit_error, sensor.bit_step, actual);
  }
  return values;
}

}  // namespace plumbline::battery::worlds
