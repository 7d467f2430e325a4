// Equations of motion of the rigs' links, derived by hand (Lagrange), as closed formulas.
#pragma once

#include "tests/battery/worlds/rig.h"

namespace plumbline::battery::worlds {

/// Arm on an axis along the world's y; body 0; p = (angle).
void pendulum_equations(const Rig& rig, const Vector& p, const Vector& rate, Matrix& mass, Vector& bias);

/// Thigh, shin and the two bars that turn with them about axes along -y; bodies thigh, shin, cspring, cshin;
/// p = (leg angle, leg shape).
void leg_bench_equations(const Rig& rig, const Vector& p, const Vector& rate, Matrix& mass, Vector& bias);

/// Body on a rail, carriage in it, foot under it; bodies body, slider, foot; p = (height, carriage out,
/// compression of the leg).
void hopper_equations(const Rig& rig, const Vector& p, const Vector& rate, Matrix& mass, Vector& bias);

/// A cart on a way that rises by rig.incline; body cart; p = (way).
void cart_equations(const Rig& rig, const Vector& p, const Vector& rate, Matrix& mass, Vector& bias);

}  // namespace plumbline::battery::worlds
