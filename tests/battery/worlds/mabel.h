// MABEL in the plane, by hand: a hip on two ways, a torso on it, two legs of two links each, the bars that
// turn with them, and the pulleys of the springs.
#pragma once

#include "tests/battery/worlds/rig.h"

namespace plumbline::battery::worlds {

/// Bodies boom, torso_link and of each leg thigh, shin, cspring, cshin; p = (hip's way, hip's height, torso,
/// left leg angle and shape, right leg angle and shape, left and right spring's pulley).
void mabel_equations(const Rig& rig, const Vector& p, const Vector& rate, Matrix& mass, Vector& bias);

Rig mabel(const model::Model& model);

}  // namespace plumbline::battery::worlds
