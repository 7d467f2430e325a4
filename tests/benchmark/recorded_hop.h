// One hop of MABEL with the torques of a controller's run.
#pragma once

#include <string>

#include "tests/benchmark/replay.h"

namespace plumbline::benchmarks {

/// The second hop of a run of robots/mabel/`model_file` under its controller, from the flight before a
/// landing to the flight before the next: start state and held torques. The controller is not in the loop,
/// because it quantises: two methods that differ by 1e-9 would get other torques.
Replay record_hop(const std::string& model_file);

}  // namespace plumbline::benchmarks
