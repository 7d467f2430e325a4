// Phases of a motion, and how large the error is in each.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// Samples of one kind. Phases of one group share out all samples of a trial.
struct Phase {
  std::string group;  ///< "contact", "stance", "between events", "time", "speed", "direction"
  std::string name;   ///< "early", "slow", "reversing"
};

/// To which phase of each group every sample belongs, for one channel.
struct PhaseTable {
  std::vector<Phase> phases;
  std::vector<std::vector<Eigen::Index>> members;  ///< by phase: sample indices
};

/// contact, where contact switches were recorded: which of them are closed (by their names, or flight).
/// stance, where they show flights: tenths of each time on the ground from one flight to the next, and what
/// is not between two flights in view (flight, or an end of the recording). time: thirds of the trial (early,
/// middle, late). speed: thirds of the samples by the channel's |velocity| (slow, medium, fast). direction:
/// velocity below minus a tenth of its root mean square, between, above (backward, turning, forward). between
/// events, where the trial has events: the stretches from one event to the next, the first eight of them and
/// the rest.
PhaseTable phases_of(const Trial& trial, const Measured& channel);

}  // namespace plumbline::validation
