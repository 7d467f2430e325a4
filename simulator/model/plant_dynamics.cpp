// Building the equations: where each effect acts.
#include "simulator/model/plant_dynamics.h"

#include <algorithm>
#include <utility>

#include "simulator/effects/supply_law.h"
#include "simulator/model/limbs.h"

namespace plumbline::model {

using effects::Place;

namespace {

/// An actuator's law: of this motor, of a limb or of all.
bool acts_on(const Model& model, const effects::Law& law, const std::string& at, const Motor& motor) {
  return law.sits_at(Place::limb) ? is_on_limb(model, at, motor) : motor.name == at;
}

std::vector<effects::Values> values_of(const Model& model) {
  std::vector<effects::Values> values;
  for (const EffectUse& use : model.effects) {
    values.push_back(use.numbers());
  }
  return values;
}

}  // namespace

PlantDynamics::PlantDynamics(const Model& model, const std::vector<Lock>& locks, contact::Terrain terrain)
    : model_(model),
      values_(values_of(model_)),
      map_(model_, values_, locks),
      bodies_(model_, values_, map_),
      n_tree_(map_.tree()),
      nz_(map_.independent()),
      feet_(model_, map_, std::move(terrain)),
      rods_(model_, map_),
      losses_(model_, map_, values_) {
  torque_ = Eigen::VectorXd::Zero(motors());  // loads may be asked for before the first evaluation
  gear_load_ = torque_;
  motor_pulleys_ = torque_;
  for (const Inertia& inertia : model_.inertias) {
    const int motor = model_.motor_index(inertia.at);
    if (motor >= 0) {
      motor_pulleys_[motor] += inertia.value.value;
    }
  }
  place_effects();
  for (const Motor& motor : model_.motors) {
    motor_lines_.push_back(map_.line_of(map_.full_direction(motor.name)));
  }
  feet_.find_links(bodies_.mechanism());
  if (links_ != nullptr) {
    links_->find_links(model_, bodies_.mechanism());
  }
  bodies_.check_mass_matrix();
  bodies_.make_loops();
}

void PlantDynamics::place_force(const effects::ForceLaw& law, int effect, int& next_state) {
  const EffectUse& use = model_.effects[static_cast<std::size_t>(effect)];
  ForceSlot slot;
  slot.law = &law;
  slot.effect = effect;
  slot.active = !law.is_null(values(effect));
  gear_friction_ = gear_friction_ || law.feels_gear_load();
  const Place place = model_.resolve(law, use.at);
  std::string motor = use.at;
  if (place == Place::ratio && model_.find_rod(use.at) != nullptr) {
    slot.line.reduced.setZero(nz_);  // it holds, or points along itself where it is evaluated
    slot.rod = slot.active ? rods_.add(use.at, bodies_.mechanism()) : -1;
  } else if (place == Place::ratio) {
    const Ratio& ratio = *model_.find_ratio(use.at);
    slot.line = map_.line_of(map_.stretch_direction(ratio));
    motor = ratio.motor;
  } else {
    slot.line = map_.line_of(map_.full_direction(use.at));
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

void PlantDynamics::place_effects() {
  // Behind the motors' own chains one of what they all hang on: supplies.
  actuators_.resize(static_cast<std::size_t>(motors()) + 1);
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
    } else if (const auto* late = dynamic_cast<const effects::SwitchLaw*>(law)) {
      switch_effects_.push_back({late, e});
    }
  }
  feet_.take(values_, next_state);
  place_links(next_state);
  losses_.take(next_state);
  change_ground();
  nx_ = next_state;
  switch_count_ = static_cast<int>(g.size() + feet_.slots().size()) + link_points();
}

void PlantDynamics::place_links(int& next_state) {
  if (model_.contacts.empty()) {
    return;
  }
  auto links = std::make_unique<LinkContacts>(model_, values_, next_state);
  if (!links->empty()) {
    links_ = std::move(links);
  }
}

void PlantDynamics::change_ground() {
  if (feet_.empty() && links_ == nullptr) {
    return;
  }
  on_ground_ = values_;
  ContactLaws::Applied applied;
  feet_.change(values_, on_ground_, applied);
  if (links_ != nullptr) {
    links_->change(values_, on_ground_, applied);
  }
}

bool PlantDynamics::set_value(ParameterId id, double value) {
  stored(id.effect)[static_cast<std::size_t>(id.parameter)] = value;
  for (ForceSlot& slot : forces_) {
    if (slot.effect == id.effect) {
      slot.active = !slot.law->is_null(values(slot.effect));
    }
  }
  change_ground();
  const bool moves_bodies = bodies_.depend_on(id.effect);
  if (moves_bodies) {
    bodies_.rebuild();
  }
  return moves_bodies;
}

std::vector<std::string> PlantDynamics::state_names() const {
  std::vector<std::string> names(static_cast<std::size_t>(nx_));
  for (int i = 0; i < nz_; ++i) {
    const std::string name = map_.name_of_independent(i);
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
  for (const LossSlot& slot : losses_.slots()) {
    label(slot.effect, slot.state);
  }
  for (const FootSlot& slot : feet_.slots()) {
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

}  // namespace plumbline::model
