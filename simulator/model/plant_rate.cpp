// The equations of motion evaluated: rates, switching functions, equilibria.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulator/model/asked_torque.h"
#include "simulator/model/hidden_states.h"
#include "simulator/model/plant_dynamics.h"
#include "simulator/model/supply.h"

namespace plumbline::model {

effects::Motion PlantDynamics::motion(const ForceSlot& slot, const double* x) const {
  double position = slot.line.offset;
  double velocity = 0.0;
  for (const LinearForm::Entry& entry : slot.line.entries) {
    position += entry.value * x[entry.index];
    velocity += entry.value * x[nz_ + entry.index];
  }
  if (slot.motor < 0) {
    return {position, velocity, 0.0};
  }
  return {position, velocity, slot.law->feels_gear_load() ? gear_load_[slot.motor] : torque_[slot.motor]};
}

double PlantDynamics::delay(int motor) const {
  double sum = 0.0;
  for (const ActuatorSlot& slot : actuators_[static_cast<std::size_t>(motor)]) {
    sum += slot.law->delay(values(slot.effect));
  }
  return sum;
}

double PlantDynamics::actuator_chain(int motor, const double* x, double commanded, double* xdot) const {
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

void PlantDynamics::deliver_torques(const double* x, const double* command, double* xdot) {
  torque_.resize(motors());
  for (int m = 0; m < motors(); ++m) {
    torque_[m] = actuator_chain(m, x, asked_torque(model_, m, command[m]), xdot);
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
void PlantDynamics::find_gear_loads(const double* x) {
  constexpr int kPasses = 4;
  bodies_.factor_at(x);
  Eigen::VectorXd unused(nx_);
  gear_load_ = torque_;
  for (int pass = 0; pass < kPasses; ++pass) {
    Q_ = -bodies_.h();
    add_forces(x, Q_, unused.data());
    bodies_.accelerate(Q_, acceleration_);
    Eigen::VectorXd load = torque_;
    for (const ForceSlot& slot : forces_) {
      if (slot.active && slot.at_motor) {
        load[slot.motor] +=
            slot.law->force(motion(slot, x), slot.state >= 0 ? x + slot.state : nullptr, values(slot.effect));
      }
    }
    for (int m = 0; m < motors(); ++m) {
      load[m] -= (bodies_.structure().extra_inertia[n_tree_ + m] + motor_pulleys_[m]) *
                 motor_lines_[static_cast<std::size_t>(m)].reduced.dot(acceleration_);
    }
    gear_load_ = load;
  }
}

void PlantDynamics::aim_rods(const double* x) {
  if (rods_.empty()) {
    return;
  }
  for (ForceSlot& slot : forces_) {
    if (slot.rod >= 0) {
      slot.line = rods_.line_at(slot.rod, bodies_.tree(), x);
    }
  }
}

effects::Motion PlantDynamics::rod_motion(const std::string& rod, const double* x) {
  if (!map_.is_released(rod)) {
    return {};
  }
  bodies_.rigid_at(x);
  const int index = rods_.add(rod, bodies_.mechanism());
  const LinearForm line = rods_.line_at(index, bodies_.tree(), x);
  const Eigen::Map<const Eigen::VectorXd> z(x, nz_);
  const Eigen::Map<const Eigen::VectorXd> w(x + nz_, nz_);
  return {line.offset + line.reduced.dot(z), line.reduced.dot(w), 0.0};
}

void PlantDynamics::add_forces(const double* x, Eigen::VectorXd& Q, double* xdot) {
  aim_rods(x);
  for (int m = 0; m < motors(); ++m) {
    for (const LinearForm::Entry& entry : motor_lines_[static_cast<std::size_t>(m)].entries) {
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
    for (const LinearForm::Entry& entry : slot.line.entries) {
      Q[entry.index] += entry.value * force;
    }
    if (slot.state >= 0 && xdot != nullptr) {
      slot.law->state_rate(at, state, p, xdot + slot.state);
    }
  }
  feet_.add_forces(bodies_.tree(), x, on_ground_, Q, xdot);
  if (links_ != nullptr) {
    add_links(x, Q, xdot);
  }
}

void PlantDynamics::rate(const double* x, const double* command, double* xdot) {
  deliver_torques(x, command, xdot);
  bodies_.factor_at(x);
  bodies_.check_charts();
  Q_ = -bodies_.h();
  add_forces(x, Q_, xdot);
  bodies_.accelerate(Q_, acceleration_);
  for (int i = 0; i < nz_; ++i) {
    xdot[i] = x[nz_ + i];
    xdot[nz_ + i] = acceleration_[i];
  }
  losses_.write_rates(x, xdot);
}

Eigen::VectorXd PlantDynamics::fall(const double* x) {
  Eigen::VectorXd at_rest = Eigen::Map<const Eigen::VectorXd>(x, nx_);
  at_rest.segment(nz_, nz_).setZero();
  bodies_.factor_at(at_rest.data());
  Eigen::VectorXd acceleration;
  bodies_.accelerate(-bodies_.h(), acceleration);
  return acceleration;
}

double PlantDynamics::switch_lateness(const std::string& contact_switch, bool closes) const {
  double late = 0.0;
  for (const SwitchSlot& slot : switch_effects_) {
    if (model_.effects[static_cast<std::size_t>(slot.effect)].at == contact_switch) {
      late += slot.law->lateness(closes, values(slot.effect));
    }
  }
  return late;
}

Eigen::RowVectorXd PlantDynamics::switch_lateness_slope(const std::string& contact_switch, bool closes,
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

void PlantDynamics::switches(const double* x, double* g) {
  std::vector<double>& all = switch_values_;
  all.clear();
  if (meets_anything() || !rods_.empty()) {
    bodies_.rigid_at(x);
    aim_rods(x);
  }
  for (const ForceSlot& slot : forces_) {
    slot.law->switches(motion(slot, x), values(slot.effect), all);
  }
  for (const FootSlot& slot : feet_.slots()) {
    all.push_back(feet_.touch(slot, bodies_.tree()).depth);
  }
  for (int point = 0; point < link_points(); ++point) {
    all.push_back(links_->touch(point, bodies_.tree()).depth);
  }
  std::copy(all.begin(), all.end(), g);
}

std::vector<ForceJump> PlantDynamics::jumps() const {
  std::vector<ForceJump> found;
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

Eigen::VectorXd PlantDynamics::equilibrium(const Eigen::VectorXd& z, const double* command) {
  constexpr double kStep = 1e-6;    // rad or m
  constexpr double kLongest = 0.3;  // of a step of Newton's method, the same
  constexpr double kRounding = 1e-9;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd xdot(nx_);
  Eigen::VectorXd lambda;
  x.head(nz_) = z;
  model::settle(*this, command, x.data());
  for (int iteration = 0; iteration < 60; ++iteration) {
    rate(x.data(), command, xdot.data());
    const Eigen::VectorXd force = bodies_.has_loops() ? bodies_.beside_loops(Q_, x.head(nz_), lambda)
                                                      : bodies_.M() * xdot.segment(nz_, nz_);
    const double scale = kRounding * (bodies_.h().cwiseAbs().maxCoeff() + torque_.cwiseAbs().sum() + 1e-6);
    if (force.cwiseAbs().maxCoeff() < scale &&
        (!bodies_.has_loops() || bodies_.held()->is_closed(x.head(nz_)))) {
      return x.head(nz_);
    }
    Eigen::MatrixXd K(nz_, nz_);
    for (int i = 0; i < nz_; ++i) {
      Eigen::VectorXd moved = x;
      moved[i] += kStep;
      rate(moved.data(), command, xdot.data());
      const Eigen::VectorXd there = bodies_.has_loops() ? bodies_.with_loops(Q_, moved.head(nz_), lambda)
                                                        : bodies_.M() * xdot.segment(nz_, nz_);
      K.col(i) = (there - force) / kStep;
    }
    const Eigen::VectorXd move = bodies_.has_loops() ? bodies_.move_along_loops(K, force, x.head(nz_))
                                                     : -K.colPivHouseholderQr().solve(force);
    const double largest = move.cwiseAbs().maxCoeff();
    x.head(nz_) += largest > kLongest ? Eigen::VectorXd(move * (kLongest / largest)) : move;
  }
  throw std::runtime_error("no static equilibrium found near the start position");
}

}  // namespace plumbline::model
