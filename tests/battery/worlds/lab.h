// What is not known of a robot: the numbers whose uncertainty its model states, and those that no model file
// states an uncertainty of, within what a laboratory would know of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/battery/draw.h"
#include "tests/battery/worlds/rig.h"

namespace plumbline::battery::worlds {

/// A number of the rig and how well it is known, one standard deviation.
struct Unknown {
  std::string name;
  std::function<void(Rig& rig, double deviations)> move;
};

/// Masses (their inertia with them), rotor inertias, torque constants and values of effects: what the
/// diagnosis may free.
std::vector<Unknown> stated(const model::Model& model);

/// What it may not free: how a laboratory would know ratios, centres of mass, lengths, sensors' zeros and the
/// delay of the commands. Reasons stand beside the values in lab.cpp.
std::vector<Unknown> unstated(const Rig& rig);

/// The model with the same stated, as a laboratory may state it: effects at their null values with that
/// uncertainty (com_shift, command_delay, encoder_offset, and encoder_scale at motors' encoders for ratios;
/// lengths have no effect).
model::Model with_tolerances(const model::Model& model);

/// Moves each by a normal draw, at most kMostDeviations.
void scatter(const std::vector<Unknown>& unknowns, Draw& draw, Rig& rig);

/// Does a finding name something that `unstated` scatters, under its own name or as a force that nobody could
/// tell from it on these rigs?
bool is_of_the_lab(const std::string& effect);

}  // namespace plumbline::battery::worlds
