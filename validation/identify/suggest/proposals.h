// Experiments that a robot could do next: shapes of commands within what it has done before.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/twin/experiment.h"

namespace plumbline::validation {

/// Which shape, for which motors of an envelope.
struct Idea {
  std::string name;    ///< "mLA: fast chirp"
  std::size_t family;  ///< chirps, multisine, steps, pulses, ramp, noise
  std::vector<std::size_t> moving;
};

/// An experiment and how it would be written in a file (docs/formats.md).
struct Proposal {
  std::string name, text;
  Experiment experiment;
};

/// What trials have shown that a robot stands: for each motor the mean of its command, which holds it against
/// gravity, and the largest distance from it; for each channel where it has been.
struct Envelope {
  struct Motor {
    std::string name, unit;
    double mean = 0.0, reach = 0.0;
  };
  struct Channel {
    std::string sensor;
    double low = 0.0, high = 0.0;
  };
  std::vector<Motor> motors;
  std::vector<Channel> channels;
  std::vector<Start> start;
  std::vector<std::string> locked;
  double duration = 0.0, period = 0.0;
};

/// Throws InputError when no command changes in any trial.
Envelope envelope_of(const std::vector<Trial>& trials, const std::vector<Start>& start);

/// Every shape for each motor alone and for all together.
std::vector<Idea> ideas_for(const Envelope& envelope);

/// The idea with `share` of the commands' reach.
Proposal propose(const model::Model& model, const Envelope& envelope, const Idea& idea, double share);

/// True when the trial stays where the robot has been, with that range once more to spare at either side.
bool stays_within(const Envelope& envelope, const Trial& trial);

}  // namespace plumbline::validation
