// How far a hidden effect shows at best, by the world that made the data alone.
#pragma once

#include "tests/battery/worlds/lab.h"
#include "tests/battery/worlds/recorder.h"

namespace plumbline::battery::worlds {

/// Windows of half a second of the recorded motion are run by the rig without what is hidden, from the true
/// positions and rates. Linear least squares then moves where each begins and, against what is stated of
/// them, the stated numbers. What is left, in floors, with the floor itself: sqrt(1 + mean square).
double visibility(const Recording& recording, const Rig& without, const std::vector<Unknown>& stated);

}  // namespace plumbline::battery::worlds
