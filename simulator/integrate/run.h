// Runs a Plant over a sampled experiment: held commands or a sampled controller, energy accounts, a summary.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulator/integrate/held_commands.h"
#include "simulator/integrate/integrator.h"
#include "simulator/model/plant.h"

namespace plumbline::integrate {

struct RunOptions {
  Options integrator;
  bool energy = true;  ///< integrate work and dissipation beside the motion
  bool events = true;  ///< locate the effects' switching functions
};

/// What a sampled controller is given and must fill: sample number, time, readings, and the command of each
/// motor (command units).
using SampledController =
    std::function<void(Eigen::Index sample, double time, const Eigen::VectorXd& readings, double* command)>;

/// What the sensors' electronics make of true positions (quantisation, noise); identity when empty.
using Readout = std::function<void(Eigen::VectorXd& readings)>;

struct RunResult {
  Eigen::VectorXd time;      ///< s
  Eigen::MatrixXd states;    ///< states x samples
  Eigen::MatrixXd outputs;   ///< sensors x samples, true positions as the sensors would read them
  Eigen::MatrixXd readings;  ///< sensors x samples, after the readout
  Eigen::MatrixXd commands;  ///< motors x samples, command units
  std::vector<Event> events;
  Summary summary;
  double energy_exchanged = 0.0;  ///< |work| + |dissipation| + swing of the stored energy, J
  double energy_error = 0.0;      ///< stored - stored(0) - work + dissipated at the end, J
};

/// `commands` holds the recorded commands; a controller, when given, overwrites them sample by sample.
/// Throws std::runtime_error when the integrator fails.
RunResult run(model::Plant& plant, const Eigen::VectorXd& x0, HeldCommands commands, double t0,
              const SampledController& controller, const Readout& readout, const RunOptions& options);

}  // namespace plumbline::integrate
