// Building a Plant: which coordinates are independent, where each effect acts.
#include "simulator/model/plant.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulator/effects/supply_law.h"
#include "simulator/model/body_change.h"
#include "simulator/model/inertial_sensors.h"
#include "simulator/model/limbs.h"
#include "simulator/model/planar_base.h"
#include "simulator/trace/error.h"

namespace plumbline::model {

using effects::Place;

namespace {

/// An actuator's law: of this motor, of a limb or of all.
bool acts_on(const Model& model, const effects::Law& law, const std::string& at, const Motor& motor) {
  return law.sits_at(Place::limb) ? is_on_limb(model, at, motor) : motor.name == at;
}

}  // namespace

Plant::Plant(const Model& model, const std::vector<Lock>& locks, contact::Terrain terrain)
    : model_(model), terrain_(std::move(terrain)) {
  for (const EffectUse& use : model_.effects) {
    values_.push_back(use.numbers());
  }
  const std::vector<int>& charts = model_.skeleton.charts;
  for (std::size_t j = 0; j < model_.skeleton.joints.size(); ++j) {
    if (std::find(charts.begin(), charts.end(), static_cast<int>(j)) != charts.end()) {
      charts_.push_back(n_tree_);
    }
    n_tree_ += model_.skeleton.joints[j].type == JointType::fixed ? 0 : 1;
  }
  n_ = n_tree_ + motors() + static_cast<int>(model_.pulleys.size());
  torque_ = Eigen::VectorXd::Zero(motors());  // loads may be asked for before the first evaluation
  gear_load_ = torque_;
  motor_pulleys_ = torque_;
  for (const Inertia& inertia : model_.inertias) {
    const int motor = model_.motor_index(inertia.at);
    if (motor >= 0) {
      motor_pulleys_[motor] += inertia.value.value;
    }
  }
  reduce(locks);
  place_effects();
  structure_ = make_structure();
  place_sensors();  // points of links ask the mechanism
  find_feet();
  if (links_ != nullptr) {
    links_->find_links(model_, *structure_.mechanism);
  }
  check_mass_matrix();
  make_loops();
}

Eigen::VectorXd Plant::full_direction(const std::string& name) const {
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(n_);
  for (int m = 0; m < motors(); ++m) {
    if (model_.motors[static_cast<std::size_t>(m)].name == name) {
      direction[n_tree_ + m] = 1.0;
      return direction;
    }
  }
  if (const Pulley* pulley = model_.find_pulley(name)) {
    direction[n_tree_ + motors() + (pulley - model_.pulleys.data())] = 1.0;
    return direction;
  }
  if (const Coordinate* coordinate = model_.find_coordinate(name)) {
    for (const Term& term : coordinate->terms) {
      if (term.of == name) {
        break;  // a coordinate that names its own joint
      }
      direction += term.factor * full_direction(term.of);
    }
    if (!direction.isZero()) {
      return direction;
    }
  }
  int index = 0;
  for (const Joint& joint : model_.skeleton.joints) {
    if (joint.type == JointType::fixed) {
      continue;
    }
    if (joint.name == name) {
      direction[index] = 1.0;
      return direction;
    }
    ++index;
  }
  throw InputError(model_.file + ": no joint, coordinate, motor or pulley is named '" + name + "'");
}

// c(q) = q_from - sum ratio_i q_i (Park et al., equation 23).
Eigen::VectorXd Plant::stretch_direction(const Ratio& ratio) const {
  Eigen::VectorXd direction = full_direction(ratio.motor);
  for (const Term& term : ratio.to) {
    direction -= term.factor * full_direction(term.of);
  }
  return direction;
}

Plant::Line Plant::line_of(const Eigen::VectorXd& full) const {
  Line line{full, S_.transpose() * full, full.dot(q0_), {}};
  for (int i = 0; i < nz_; ++i) {
    if (line.reduced[i] != 0.0) {
      line.entries.push_back({i, line.reduced[i]});
    }
  }
  return line;
}

bool Plant::is_released(const Ratio& ratio) const {
  for (std::size_t e = 0; e < model_.effects.size(); ++e) {
    const EffectUse& use = model_.effects[e];
    if (model_.resolve(*use.law, use.at) != Place::ratio || use.law->is_null(values_[e].data())) {
      continue;
    }
    if (model_.find_ratio(use.at) == &ratio) {
      return true;
    }
  }
  return false;
}

// Gauss elimination of the rigid ratios and locks. Each row gives up one coordinate: a ratio its motor, a
// lock the coordinate with the largest remaining coefficient.
void Plant::reduce(const std::vector<Lock>& locks) {
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> right;
  std::vector<std::string> names;
  std::vector<int> preferred;
  for (const Ratio& ratio : model_.ratios) {
    if (is_released(ratio)) {
      continue;
    }
    rows.push_back(stretch_direction(ratio));
    right.push_back(0.0);
    names.push_back("ratio " + ratio.name);
    Eigen::Index pivot = 0;
    full_direction(ratio.motor).cwiseAbs().maxCoeff(&pivot);
    preferred.push_back(static_cast<int>(pivot));
  }
  for (const Lock& lock : locks) {
    rows.push_back(full_direction(lock.at));
    right.push_back(lock.value);
    names.push_back("lock of " + lock.at);
    preferred.push_back(-1);
  }
  const auto r = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd A(r, n_);
  Eigen::VectorXd b(r);
  for (Eigen::Index i = 0; i < r; ++i) {
    A.row(i) = rows[static_cast<std::size_t>(i)].transpose();
    b[i] = right[static_cast<std::size_t>(i)];
  }
  std::vector<Eigen::Index> pivots;
  std::vector<bool> dependent(static_cast<std::size_t>(n_), false);
  for (Eigen::Index i = 0; i < r; ++i) {
    const double size = A.row(i).cwiseAbs().maxCoeff();
    Eigen::Index pivot = preferred[static_cast<std::size_t>(i)];
    if (pivot < 0 || dependent[static_cast<std::size_t>(pivot)] || std::abs(A(i, pivot)) < 1e-9) {
      A.row(i).cwiseAbs().maxCoeff(&pivot);
    }
    if (!(size > 1e-9) || std::abs(A(i, pivot)) < 1e-9) {
      throw InputError(
          model_.file + ": " + names[static_cast<std::size_t>(i)] +
          ": found a constraint that repeats or contradicts the others, expected an independent one");
    }
    b[i] /= A(i, pivot);
    A.row(i) /= A(i, pivot);
    for (Eigen::Index k = 0; k < r; ++k) {
      if (k != i && A(k, pivot) != 0.0) {
        b[k] -= A(k, pivot) * b[i];
        A.row(k) -= A(k, pivot) * A.row(i).eval();
      }
    }
    pivots.push_back(pivot);
    dependent[static_cast<std::size_t>(pivot)] = true;
  }
  nz_ = n_ - static_cast<int>(r);
  if (nz_ <= 0) {
    throw InputError(model_.file +
                     ": found no coordinate left to move, expected at least one that is neither "
                     "locked nor tied");
  }
  S_ = Eigen::MatrixXd::Zero(n_, nz_);
  q0_ = Eigen::VectorXd::Zero(n_);
  Eigen::Index column = 0;
  for (Eigen::Index j = 0; j < n_; ++j) {
    if (dependent[static_cast<std::size_t>(j)]) {
      continue;
    }
    S_(j, column) = 1.0;
    independent_.push_back(static_cast<int>(j));
    for (std::size_t i = 0; i < pivots.size(); ++i) {
      S_(pivots[i], column) = -A(static_cast<Eigen::Index>(i), j);
    }
    ++column;
  }
  for (std::size_t i = 0; i < pivots.size(); ++i) {
    q0_[pivots[i]] = b[static_cast<Eigen::Index>(i)];
  }
  S_tree_ = S_.topRows(n_tree_);
  S_rows_.resize(static_cast<std::size_t>(n_tree_));
  for (int i = 0; i < n_tree_; ++i) {
    for (int k = 0; k < nz_; ++k) {
      if (S_tree_(i, k) != 0.0) {
        S_rows_[static_cast<std::size_t>(i)].push_back({k, S_tree_(i, k)});
      }
    }
  }
}

void Plant::place_force(const effects::ForceLaw& law, int effect, int& next_state) {
  const EffectUse& use = model_.effects[static_cast<std::size_t>(effect)];
  ForceSlot slot;
  slot.law = &law;
  slot.effect = effect;
  slot.active = !law.is_null(values(effect));
  gear_friction_ = gear_friction_ || law.feels_gear_load();
  const Place place = model_.resolve(law, use.at);
  std::string motor = use.at;
  if (place == Place::ratio) {
    const Ratio& ratio = *model_.find_ratio(use.at);
    slot.line = line_of(stretch_direction(ratio));
    motor = ratio.motor;
  } else {
    slot.line = line_of(full_direction(use.at));
  }
  for (int m = 0; m < motors(); ++m) {
    if (model_.motors[static_cast<std::size_t>(m)].name == motor) {
      slot.motor = m;
      slot.at_motor = place == Place::motor;
    }
  }
  if (law.state_count() > 0 && slot.active) {
    slot.state = next_state;
    next_state += law.state_count();
  }
  forces_.push_back(slot);
}

void Plant::place_effects() {
  // Behind the motors' own chains one of what they all hang on: supplies.
  actuators_.resize(static_cast<std::size_t>(motors()) + 1);
  sensor_effects_.resize(static_cast<std::size_t>(sensors()));
  int next_state = 2 * nz_;
  std::vector<double> g;
  for (int e = 0; e < static_cast<int>(model_.effects.size()); ++e) {
    const EffectUse& use = model_.effects[static_cast<std::size_t>(e)];
    const effects::Law* law = use.law.get();
    if (const auto* force = dynamic_cast<const effects::ForceLaw*>(law)) {
      place_force(*force, e, next_state);
      force->switches({}, values(e), g);
    } else if (const auto* actuator = dynamic_cast<const effects::ActuatorLaw*>(law)) {
      const bool has_state = law->state_count() > 0 && !law->is_null(values(e));
      for (std::size_t m = 0; m < model_.motors.size(); ++m) {
        if (acts_on(model_, *law, use.at, model_.motors[m])) {
          actuators_[m].push_back({actuator, e, has_state ? next_state : -1});
        }
      }
      if (dynamic_cast<const effects::SupplyLaw*>(law) != nullptr) {
        actuators_.back().push_back({actuator, e, -1});
      }
      next_state += has_state ? law->state_count() : 0;
    } else if (const auto* structure = dynamic_cast<const effects::StructureLaw*>(law)) {
      structures_.push_back({structure, e});
    } else if (const auto* sensor = dynamic_cast<const effects::SensorLaw*>(law)) {
      for (std::size_t s = 0; s < model_.sensors.size(); ++s) {
        if (model_.sensors[s].name == use.at || sits_at_first(*law, use.at, model_.sensors[s])) {
          sensor_effects_[s].push_back({sensor, e});
        }
      }
    } else if (const auto* late = dynamic_cast<const effects::SwitchLaw*>(law)) {
      switch_effects_.push_back({late, e});
    }
  }
  place_ground(next_state);
  nx_ = next_state;
  switch_count_ = static_cast<int>(g.size() + feet_.size()) + link_points();
  Eigen::Index released = 0;
  stretch_map_.resize(static_cast<Eigen::Index>(model_.ratios.size()), nz_);
  for (const Ratio& ratio : model_.ratios) {
    if (is_released(ratio)) {
      stretch_map_.row(released++) = (S_.transpose() * stretch_direction(ratio)).transpose();
    }
  }
  stretch_map_.conservativeResize(released, nz_);
}

void Plant::place_sensors() {
  output_map_.resize(sensors(), nz_);
  output_offset_.resize(sensors());
  for (int s = 0; s < sensors(); ++s) {
    const Sensor& sensor = model_.sensors[static_cast<std::size_t>(s)];
    if (sensor.is_force_plate()) {
      output_map_.row(s).setZero();
      output_offset_[s] = 0.0;
      continue;
    }
    if (sensor.is_at_point()) {
      place_point_sensor(s);
      continue;
    }
    const Line line = line_of(full_direction(sensor.measures));
    output_map_.row(s) = line.reduced.transpose();
    output_offset_[s] = sensor.rate ? sensor.offset : line.offset + sensor.offset;
  }
  for (const Motor& motor : model_.motors) {
    motor_lines_.push_back(line_of(full_direction(motor.name)));
  }
}

void Plant::apply_change(const StructureSlot& slot, Skeleton& skeleton, Eigen::VectorXd& inertia) const {
  const EffectUse& use = model_.effects[static_cast<std::size_t>(slot.effect)];
  const effects::StructureChange change = slot.law->change(values(slot.effect));
  switch (model_.resolve(*slot.law, use.at)) {
    case Place::body: {
      Body& body = skeleton.bodies[static_cast<std::size_t>(model_.body_index(use.at))];
      change_body(body, change, model_.file + ": " + use.label());
      return;
    }
    case Place::world:
      if (change.tilt.norm() > 0.0) {
        skeleton.gravity = Eigen::AngleAxisd(change.tilt.norm(), change.tilt.normalized()) * skeleton.gravity;
      }
      return;
    case Place::base:
      bend_base(skeleton, *planar_base(skeleton), change.curvature, change.level);
      return;
    default:
      for (int m = 0; m < motors(); ++m) {
        if (model_.motors[static_cast<std::size_t>(m)].name == use.at) {
          inertia[n_tree_ + m] += change.inertia;
        }
      }
  }
}

Plant::Structure Plant::make_structure() const {
  Structure structure;
  Skeleton skeleton = model_.skeleton;
  structure.extra_inertia = Eigen::VectorXd::Zero(n_);
  for (int m = 0; m < motors(); ++m) {
    structure.extra_inertia[n_tree_ + m] = model_.motors[static_cast<std::size_t>(m)].rotor_inertia.value;
  }
  for (std::size_t p = 0; p < model_.pulleys.size(); ++p) {
    structure.extra_inertia[n_tree_ + motors() + static_cast<int>(p)] = model_.pulleys[p].inertia.value;
  }
  for (const StructureSlot& slot : structures_) {
    apply_change(slot, skeleton, structure.extra_inertia);
  }
  structure.extra_reduced = S_.transpose() * structure.extra_inertia.asDiagonal() * S_;
  for (const Inertia& inertia : model_.inertias) {
    const Eigen::VectorXd a = S_.transpose() * full_direction(inertia.at);
    structure.extra_reduced += inertia.value.value * a * a.transpose();
  }
  structure.mechanism = std::make_unique<Mechanism>(skeleton);
  return structure;
}

void Plant::check_mass_matrix() {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(nx_);
  factor_at(x.data());
  const bool positive = factor_.info() == Eigen::Success && M_.allFinite() && M_.diagonal().minCoeff() > 0.0;
  if (!positive || factor_.rcond() < 1e-13) {
    throw InputError(
        model_.file + ": found a singular mass matrix (" + std::to_string(nz_) +
        " independent coordinates), expected every coordinate to move some inertia; check masses, "
        "rotor inertias and ratios");
  }
}

// Joints that move, motors, pulleys.
std::string Plant::coordinate_name(int full) const {
  if (full >= n_tree_ + motors()) {
    return model_.pulleys[static_cast<std::size_t>(full - n_tree_ - motors())].name;
  }
  if (full >= n_tree_) {
    return model_.motors[static_cast<std::size_t>(full - n_tree_)].name;
  }
  int index = 0;
  for (const Joint& joint : model_.skeleton.joints) {
    if (joint.type != JointType::fixed && index++ == full) {
      return joint.name;
    }
  }
  return "";
}

std::vector<std::string> Plant::state_names() const {
  std::vector<std::string> names(static_cast<std::size_t>(nx_));
  for (int i = 0; i < nz_; ++i) {
    const std::string name = coordinate_name(independent_[static_cast<std::size_t>(i)]);
    names[static_cast<std::size_t>(i)] = "position of " + name;
    names[static_cast<std::size_t>(nz_ + i)] = "velocity of " + name;
  }
  const auto label = [&](int effect, int state, const std::string& of_group = "") {
    if (state < 0) {
      return;
    }
    const EffectUse& use = model_.effects[static_cast<std::size_t>(effect)];
    const auto& states = use.law->declaration().states;
    for (std::size_t k = 0; k < states.size(); ++k) {
      names[static_cast<std::size_t>(state) + k] = states[k] + " of " + use.label() + of_group;
    }
  };
  for (const ForceSlot& slot : forces_) {
    label(slot.effect, slot.state);
  }
  for (const auto& chain : actuators_) {
    for (const ActuatorSlot& slot : chain) {
      label(slot.effect, slot.state);
    }
  }
  for (const FootSlot& slot : feet_) {
    const Foot& foot = model_.feet[static_cast<std::size_t>(slot.foot)];
    for (const FootSlot::Drag& use : slot.drags) {
      label(use.effect, use.state, foot.group.empty() ? "" : " (" + foot.name + ")");
    }
  }
  for (int point = 0; point < link_points(); ++point) {
    for (const ContactLaws::Drag& use : links_->laws(point).drags) {
      label(use.effect, use.state, links_->number_of(point));
    }
  }
  return names;
}

double Plant::value(ParameterId id) const {
  return values_[static_cast<std::size_t>(id.effect)][static_cast<std::size_t>(id.parameter)];
}

void Plant::set_value(ParameterId id, double value) {
  values_[static_cast<std::size_t>(id.effect)][static_cast<std::size_t>(id.parameter)] = value;
  for (ForceSlot& slot : forces_) {
    if (slot.effect == id.effect) {
      slot.active = !slot.law->is_null(values(slot.effect));
    }
  }
  change_ground();
  for (const StructureSlot& slot : structures_) {
    if (slot.effect == id.effect) {
      structure_ = make_structure();
      rigid_known_ = false;
      variants_.clear();
    }
  }
}

Eigen::VectorXd Plant::joint_positions(const double* x) const {
  return S_tree_ * Eigen::Map<const Eigen::VectorXd>(x, nz_) + q0_.head(n_tree_);
}

double Plant::position_of(const std::string& name, const double* x) const {
  const Line line = line_of(full_direction(name));
  return line.offset + line.reduced.dot(Eigen::Map<const Eigen::VectorXd>(x, nz_));
}

double Plant::velocity_of(const std::string& name, const double* x) const {
  const Line line = line_of(full_direction(name));
  return line.reduced.dot(Eigen::Map<const Eigen::VectorXd>(x + nz_, nz_));
}

// 1 / (a' M^-1 a): what a force along the place has to accelerate.
double Plant::inertia_of(const std::string& name) {
  const Eigen::VectorXd a = S_.transpose() * full_direction(name);
  const double mobility = a.dot(accelerated(a));
  return mobility > 0.0 ? 1.0 / mobility : std::numeric_limits<double>::infinity();
}

effects::Motion Plant::motion_at(Place place, const std::string& at, const double* x) const {
  const Line line =
      line_of(place == Place::ratio ? stretch_direction(*model_.find_ratio(at)) : full_direction(at));
  return {line.offset + line.reduced.dot(Eigen::Map<const Eigen::VectorXd>(x, nz_)),
          line.reduced.dot(Eigen::Map<const Eigen::VectorXd>(x + nz_, nz_)), 0.0};
}

}  // namespace plumbline::model
