// One second of a quadruped that stands under a PD law, in the loop: the program beside MuJoCo.
#pragma once

#include <filesystem>

#include "simulator/model/model.h"
#include "tests/model/mujoco_peer.h"

namespace plumbline::benchmarks {

/// Prints a table: processor time of the program at relative tolerances of 1e-4 and 1e-6, with the largest
/// difference of a joint's angle from a run at 1e-8; of MuJoCo at its file's time step and at 0.1 ms.
/// `skeleton` is that of folder/robot.xml, which has a floor and a keyframe to stand in; `mujoco` has that
/// file loaded. The motors' torques are the PD law's: 80 N m/rad, 2 N m s/rad, every 2 ms; the ground is
/// 1e4 N/m and 150 N s/m under each foot.
void time_standing(const std::filesystem::path& folder, const model::Skeleton& skeleton,
                   const test::Mujoco& mujoco);

}  // namespace plumbline::benchmarks
