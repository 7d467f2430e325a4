// Effects that a model states in other words: a motor's winding, and what the skeleton says of its joints.
#pragma once

#include "simulator/effects/catalogue.h"
#include "simulator/model/model.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::model {

/// `winding` of a motor whose command is a voltage u: torque = k/R (u - k_e v), with the torque constant k of
/// the current, the resistance R and the back EMF k_e (left out: equal to k, as in a motor without losses).
/// Sets the torque constant per volt to k/R. The other part is viscous friction k k_e/R at the motor, see
/// add_back_emf. Inductance is neglected: it matters below about L/R, some 0.1 to 1 ms. Source: any text on
/// DC motors, such as Siciliano, Sciavicco, Villani and Oriolo, Robotics, 2009, section 5.2.
void read_winding(const YamlNode& node, Motor& motor);

/// Adds the viscous friction of every `winding` in the section `motors`.
void add_back_emf(const YamlNode& motors, const effects::Catalogue& catalogue, Model& model);

/// `joint_dynamics: take`: damping, dry friction and armature that the skeleton file states become the
/// effects viscous and coulomb and an inertia at the coordinate that is that joint alone. Throws InputError
/// when there is none. `leave`: they stay what `check` mentions.
void take_joint_dynamics(const YamlNode& node, const effects::Catalogue& catalogue, Model& model);

/// What the skeleton says of its joints' friction and nobody took over, a sentence each.
std::vector<std::string> joint_dynamics_left(const Model& model);

}  // namespace plumbline::model
