// A robot of a foreign world that hops under the project's controller.
#pragma once

#include <random>

#include "simulator/run/scenario.h"
#include "tests/battery/worlds/recorder.h"

namespace plumbline::battery::worlds {

/// From a start in the air until all feet have landed together `hops` + 1 times, behind a flight each: that
/// many hops. The controller gets counts and switches as trial_of() will write them where `noise` is as it
/// will be there. Throws std::invalid_argument for a start that the rig has not, std::runtime_error when the
/// robot does not hop so often.
Recording hop(const Rig& rig, const run::LoadedScenario& loaded, const run::Start& start, int hops,
              std::mt19937_64 noise);

/// What trial_of() wants to know of such a recording.
validation::Experiment experiment_of(const Recording& recording, const std::string& title,
                                     validation::Role role);

}  // namespace plumbline::battery::worlds
