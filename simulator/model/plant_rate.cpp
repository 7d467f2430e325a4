// The equations of motion of a Plant.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "simulator/model/asked_torque.h"
#include "simulator/model/joint_chain.h"
#include "simulator/model/late_reading.h"
#include "simulator/model/plant.h"
#include "simulator/model/supply.h"

namespace plumbline::model {

using Vector = Eigen::Map<const Eigen::VectorXd>;

effects::Motion Plant::motion(const ForceSlot& slot, const double* x) const {
  double position = slot.line.offset;
  double velocity = 0.0;
  for (const Entry& entry : slot.line.entries) {
    position += entry.value * x[entry.index];
    velocity += entry.value * x[nz_ + entry.index];
  }
  if (slot.motor < 0) {
    return {position, velocity, 0.0};
  }
  return {position, velocity, slot.law->feels_gear_load() ? gear_load_[slot.motor] : torque_[slot.motor]};
}

// A constant per ampere or volt beside a command that is a torque already says how that torque was made.
double Plant::torque_gain(int motor) const {
  const Motor& m = model_.motors[static_cast<std::size_t>(motor)];
  const bool commands_force = m.command_unit == "N m" || m.command_unit == "N";
  const bool applies = m.torque_constant.value > 0.0 && (!commands_force || m.torque_constant.unit == "1");
  return applies ? m.torque_constant.value : 1.0;
}

double Plant::delay(int motor) const {
  double sum = 0.0;
  for (const ActuatorSlot& slot : actuators_[static_cast<std::size_t>(motor)]) {
    sum += slot.law->delay(values(slot.effect));
  }
  return sum;
}

std::vector<double> Plant::delays() const {
  std::vector<double> all(static_cast<std::size_t>(motors()));
  for (int m = 0; m < motors(); ++m) {
    all[static_cast<std::size_t>(m)] = delay(m);
  }
  return all;
}

// From the command (torque units) through all actuator effects to the delivered torque. State rates are
// written when xdot is given.
double Plant::actuator_chain(int motor, const double* x, double commanded, double* xdot) const {
  double torque = commanded;
  for (const ActuatorSlot& slot : actuators_[static_cast<std::size_t>(motor)]) {
    const double* p = values(slot.effect);
    if (slot.state >= 0 && xdot != nullptr) {
      slot.law->state_rate(torque, x + slot.state, p, xdot + slot.state);
    }
    if (slot.state >= 0 || slot.law->state_count() == 0) {
      torque = slot.law->torque(torque, slot.state >= 0 ? x + slot.state : nullptr, p);
    }
  }
  return torque;
}

void Plant::deliver_torques(const double* x, const double* command, double* xdot) {
  torque_.resize(motors());
  for (int m = 0; m < motors(); ++m) {
    torque_[m] = actuator_chain(m, x, asked_torque(*this, m, command[m]), xdot);
  }
  if (!actuators_.back().empty()) {
    const auto of = [&](const ActuatorSlot& slot) { return values(slot.effect); };
    torque_ *= Supplies(actuators_.back(), motor_lines_, of, x + nz_).share(torque_);
  }
  if (gear_friction_) {
    find_gear_loads(x);
  }
}

// What a gear passes on depends on the acceleration, and this on the friction that the load makes: each pass
// brings both nearer to each other by the friction's coefficient, which is a few hundredths.
void Plant::find_gear_loads(const double* x) {
  constexpr int kPasses = 4;
  factor_at(x);
  Eigen::VectorXd unused(nx_);
  gear_load_ = torque_;
  for (int pass = 0; pass < kPasses; ++pass) {
    Q_ = -h_;
    add_forces(x, Q_, unused.data());
    accelerate(Q_, acceleration_);
    Eigen::VectorXd load = torque_;
    for (const ForceSlot& slot : forces_) {
      if (slot.active && slot.at_motor) {
        load[slot.motor] +=
            slot.law->force(motion(slot, x), slot.state >= 0 ? x + slot.state : nullptr, values(slot.effect));
      }
    }
    for (int m = 0; m < motors(); ++m) {
      load[m] -= (structure_.extra_inertia[n_tree_ + m] + motor_pulleys_[m]) *
                 motor_lines_[static_cast<std::size_t>(m)].reduced.dot(acceleration_);
    }
    gear_load_ = load;
  }
}

// S has few entries that are not zero: S' M S by columns of M.
void Plant::evaluate_rigid(const double* x, Structure& structure, Eigen::MatrixXd& M, Eigen::VectorXd& h) {
  rigid_known_ = false;
  q_ = q0_.head(n_tree_);
  v_.setZero(n_tree_);
  for (int j = 0; j < n_tree_; ++j) {
    for (const Entry& entry : S_rows_[static_cast<std::size_t>(j)]) {
      q_[j] += entry.value * x[entry.index];
      v_[j] += entry.value * x[nz_ + entry.index];
    }
  }
  structure.mechanism->evaluate(q_, v_, M_tree_, h_tree_);
  SM_.setZero(nz_, n_tree_);
  M = structure.extra_reduced;
  h.setZero(nz_);
  for (int j = 0; j < n_tree_; ++j) {
    for (int i = 0; i < n_tree_; ++i) {
      for (const Entry& entry : S_rows_[static_cast<std::size_t>(i)]) {
        SM_(entry.index, j) += entry.value * M_tree_(i, j);
      }
    }
    for (const Entry& entry : S_rows_[static_cast<std::size_t>(j)]) {
      M.col(entry.index) += entry.value * SM_.col(j);
      h[entry.index] += entry.value * h_tree_[j];
    }
  }
}

// Jacobians, switches and the first stage of a step ask for the same positions and velocities one after the
// other.
void Plant::rigid_at(const double* x) {
  if (rigid_known_ && std::equal(x, x + 2 * nz_, known_.data())) {
    return;
  }
  evaluate_rigid(x, structure_, M_, h_);
  known_ = Vector(x, 2 * nz_);
  rigid_known_ = true;
  factored_ = false;
}

void Plant::factor_at(const double* x) {
  rigid_at(x);
  if (!factored_) {
    factor_.compute(M_);
    factored_ = true;
    if (has_loops()) {
      hold_loops();
    }
  }
}

void Plant::add_forces(const double* x, Eigen::VectorXd& Q, double* xdot) {
  for (int m = 0; m < motors(); ++m) {
    for (const Entry& entry : motor_lines_[static_cast<std::size_t>(m)].entries) {
      Q[entry.index] += entry.value * torque_[m];
    }
  }
  for (const ForceSlot& slot : forces_) {
    if (!slot.active) {
      continue;
    }
    const effects::Motion at = motion(slot, x);
    const double* state = slot.state >= 0 ? x + slot.state : nullptr;
    const double* p = values(slot.effect);
    const double force = slot.law->force(at, state, p);
    for (const Entry& entry : slot.line.entries) {
      Q[entry.index] += entry.value * force;
    }
    if (slot.state >= 0 && xdot != nullptr) {
      slot.law->state_rate(at, state, p, xdot + slot.state);
    }
  }
  add_ground(x, Q, xdot);
  if (links_ != nullptr) {
    add_links(x, Q, xdot);
  }
}

// Joint positions are those of the last evaluation.
void Plant::check_charts() const {
  for (const int pitch : charts_) {
    if (std::abs(std::cos(q_[pitch])) < kLostCosineOfPitch) {
      throw std::runtime_error(model_.file + ": " +
                               chart_refusal(coordinate_name(pitch), q_[pitch], kLostCosineOfPitch));
    }
  }
}

void Plant::rate(const double* x, const double* command, double* xdot) {
  deliver_torques(x, command, xdot);
  factor_at(x);
  check_charts();
  Q_ = -h_;
  add_forces(x, Q_, xdot);
  accelerate(Q_, acceleration_);
  for (int i = 0; i < nz_; ++i) {
    xdot[i] = x[nz_ + i];
    xdot[nz_ + i] = acceleration_[i];
  }
}

Eigen::VectorXd Plant::fall(const double* x) {
  Eigen::VectorXd at_rest = Eigen::Map<const Eigen::VectorXd>(x, nx_);
  at_rest.segment(nz_, nz_).setZero();
  factor_at(at_rest.data());
  Eigen::VectorXd acceleration;
  accelerate(-h_, acceleration);
  return acceleration;
}

void Plant::raise_speeds(const double* x, double* speeds) {
  rigid_at(x);
  const Vector w(x + nz_, nz_);
  double twice_energy = 0.0;
  for (int i = 0; i < nz_; ++i) {
    twice_energy += w[i] * M_.col(i).dot(w);
  }
  for (int i = 0; i < nz_; ++i) {
    speeds[i] = std::max(speeds[i], std::sqrt(twice_energy / M_(i, i)));
  }
}

void Plant::outputs(const double* x, double* y, const double* command) {
  for (int s = 0; s < sensors(); ++s) {
    const double* seen = model_.sensors[static_cast<std::size_t>(s)].rate ? x + nz_ : x;
    double reading = output_offset_[s];
    for (int i = 0; i < nz_; ++i) {
      reading += output_map_(s, i) * seen[i];
    }
    const std::vector<SensorSlot>& chain = sensor_effects_[static_cast<std::size_t>(s)];
    if (!chain.empty()) {
      const double lag = lag_of(chain, [&](const SensorSlot& slot) { return values(slot.effect); });
      reading -= lag * output_map_.row(s).dot(Vector(x + nz_, nz_));
    }
    for (const SensorSlot& slot : chain) {
      reading = slot.law->reading(reading, values(slot.effect));
    }
    y[s] = reading;
  }
  plate_outputs(x, y);
  point_outputs(x, command, y);
}

double Plant::switch_lateness(const std::string& contact_switch, bool closes) const {
  double late = 0.0;
  for (const SwitchSlot& slot : switch_effects_) {
    if (model_.effects[static_cast<std::size_t>(slot.effect)].at == contact_switch) {
      late += slot.law->lateness(closes, values(slot.effect));
    }
  }
  return late;
}

Eigen::RowVectorXd Plant::switch_lateness_slope(const std::string& contact_switch, bool closes,
                                                const std::vector<ParameterId>& parameters) const {
  Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  for (const SwitchSlot& slot : switch_effects_) {
    if (model_.effects[static_cast<std::size_t>(slot.effect)].at != contact_switch) {
      continue;
    }
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (parameters[i].effect == slot.effect) {
        effects::Values unit(static_cast<std::size_t>(slot.law->parameter_count()), 0.0);
        unit[static_cast<std::size_t>(parameters[i].parameter)] = 1.0;
        slope[static_cast<Eigen::Index>(i)] = slot.law->lateness(closes, unit.data());
      }
    }
  }
  return slope;
}

void Plant::switches(const double* x, double* g) {
  std::vector<double>& all = switch_values_;
  all.clear();
  for (const ForceSlot& slot : forces_) {
    slot.law->switches(motion(slot, x), values(slot.effect), all);
  }
  if (meets_anything()) {
    rigid_at(x);
  }
  for (const FootSlot& slot : feet_) {
    all.push_back(touch(slot).depth);
  }
  for (int point = 0; point < link_points(); ++point) {
    all.push_back(links_->touch(point, tree()).depth);
  }
  std::copy(all.begin(), all.end(), g);
}

std::vector<Plant::Jump> Plant::jumps() const {
  std::vector<Jump> found;
  std::vector<double> own;
  int first = 0;
  for (const ForceSlot& slot : forces_) {
    for (int i = 0; i < slot.law->jumps(values(slot.effect)); ++i) {
      found.push_back({first + i, slot.effect});
    }
    own.clear();
    slot.law->switches(effects::Motion(), values(slot.effect), own);
    first += static_cast<int>(own.size());
  }
  return found;
}

Energetics Plant::energetics(const double* x, const double* command) {
  deliver_torques(x, command, nullptr);
  rigid_at(x);
  Energetics e = powers(x);
  const Vector w(x + nz_, nz_);
  e.stored += structure_.mechanism->energy(q_, v_) + 0.5 * w.dot(structure_.extra_reduced * w);
  return e;
}

Energetics Plant::powers(const double* x) const {
  Energetics e;
  const Vector w(x + nz_, nz_);
  for (int m = 0; m < motors(); ++m) {
    e.input += torque_[m] * motor_lines_[static_cast<std::size_t>(m)].reduced.dot(w);
  }
  for (const ForceSlot& slot : forces_) {
    if (!slot.active) {
      continue;
    }
    const effects::Motion at = motion(slot, x);
    const double* state = slot.state >= 0 ? x + slot.state : nullptr;
    e.stored += slot.law->stored_energy(at, state, values(slot.effect));
    e.dissipated += slot.law->dissipated_power(at, state, values(slot.effect));
  }
  ground_energetics(x, e);
  if (links_ != nullptr) {
    link_energetics(x, e);
  }
  return e;
}

Eigen::VectorXd Plant::equilibrium(const Eigen::VectorXd& z, const double* command) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd xdot(nx_);
  x.head(nz_) = z;
  settle(command, x.data());
  for (int iteration = 0; iteration < 60; ++iteration) {
    rate(x.data(), command, xdot.data());
    const Eigen::VectorXd force = M_ * xdot.segment(nz_, nz_);
    const double scale = 1e-9 * (h_.cwiseAbs().maxCoeff() + torque_.cwiseAbs().sum() + 1e-6);
    if (force.cwiseAbs().maxCoeff() < scale && (!has_loops() || closure_->is_closed(x.head(nz_)))) {
      return x.head(nz_);
    }
    Eigen::MatrixXd K(nz_, nz_);
    for (int i = 0; i < nz_; ++i) {
      const double step = 1e-6;
      Eigen::VectorXd moved = x;
      moved[i] += step;
      rate(moved.data(), command, xdot.data());
      K.col(i) = (M_ * xdot.segment(nz_, nz_) - force) / step;
    }
    Eigen::VectorXd move =
        has_loops() ? move_along_loops(K, force, x) : -K.colPivHouseholderQr().solve(force);
    const double largest = move.cwiseAbs().maxCoeff();
    x.head(nz_) += largest > 0.3 ? move * (0.3 / largest) : move;
  }
  throw std::runtime_error("no static equilibrium found near the start position");
}

}  // namespace plumbline::model
