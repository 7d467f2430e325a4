// A plant under recorded commands, or under a controller that is a function: a whole recording in one piece.
#pragma once

#include <functional>
#include <vector>

#include "simulator/run/sensors.h"
#include "simulator/run/simulation.h"

namespace plumbline::run {

struct CommandedOptions {
  integrate::Options integrator;
  bool energy = true;  ///< integrate work and dissipation beside the motion
  bool events = true;  ///< locate the effects' switching functions
  /// What was commanded before t0, of each motor; empty: the first commands have held for ever. The hidden
  /// states in x0 are the caller's.
  Eigen::VectorXd before{};
};

/// What a sampled controller is given and must fill: sample number, time, readings, and the command of each
/// motor (command units).
using SampledController =
    std::function<void(Eigen::Index sample, double time, const Eigen::VectorXd& readings, double* command)>;

struct CommandedRun {
  Eigen::VectorXd time;      ///< s
  Eigen::MatrixXd states;    ///< states x samples
  Eigen::MatrixXd outputs;   ///< sensors x samples, true positions as the sensors would read them
  Eigen::MatrixXd readings;  ///< sensors x samples, what the sensors read
  Eigen::MatrixXd switches;  ///< contact switches x samples, 1 closed
  Eigen::MatrixXd commands;  ///< motors x samples, command units
  std::vector<integrate::Event> events;
  integrate::Summary summary;
  double energy_exchanged = 0.0;  ///< |work| + |dissipation| + swing of the stored energy, J
  double energy_error = 0.0;      ///< stored - stored(0) - work + dissipated at the end, J
};

/// `commands`: motors x samples, recorded ones; a controller, when given, overwrites them sample by sample.
/// `sensors` nullptr: readings are the true positions. Throws std::runtime_error when the integrator fails.
CommandedRun run_commands(model::Plant& plant, const Eigen::VectorXd& x0, const Eigen::MatrixXd& commands,
                          double period, double t0, const SampledController& controller, Sensors* sensors,
                          const CommandedOptions& options);

}  // namespace plumbline::run
