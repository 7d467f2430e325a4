// The same rigs in MuJoCo: its rigid bodies, its integrator (RK4 at 20 us), rigid gears as its equality
// constraints, springs and dampers of joints and tendons its own, Coulomb friction as its friction-loss
// constraint (no smoothing at all).
#pragma once

#include "tests/battery/worlds/machine.h"

namespace plumbline::battery::worlds {

/// Was the program built with MuJoCo?
bool has_mujoco();

/// The rig from rest at `start` over `count` samples. Throws std::runtime_error with MuJoCo's reason, or
/// without MuJoCo.
Motion run_in_mujoco(const Rig& rig, const std::string& robot, const std::vector<std::string>& locked,
                     const Vector& start, Eigen::Index count, double period, const Commander& command);

}  // namespace plumbline::battery::worlds
