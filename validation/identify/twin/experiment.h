// An experiment to run on a model in place of a robot: which commands, from where, for how long.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

struct Experiment {
  std::string file;
  std::string title;
  Role role = Role::train;
  double duration = 0.0;            ///< s; the last sample is one period before it
  double period = 1e-3;             ///< s
  Eigen::VectorXd time;             ///< s, k period
  std::vector<Start> start;         ///< coordinates not named start at 0; everything at rest
  std::vector<std::string> locked;  ///< coordinates or motors held where they start
  std::vector<Command> commands;    ///< one for each motor named; column u_MOTOR, unit the motor's
  /// With their references; what `commands` says of a controlled motor is added to its command.
  std::vector<Controller> controllers;
};

/// Reads experiment.yaml and samples its commands. Throws InputError (one line: file, line, key, found,
/// expected) on unknown keys, kinds, motors and coordinates, wrong units, impossible shapes, frequencies that
/// the sample period cannot show, fewer than 20 samples and a duration that is not a whole number of periods.
Experiment read_experiment(const std::string& path, const model::Model& model);
/// The same from text; `name` stands for the file in messages.
Experiment parse_experiment(const std::string& text, const std::string& name, const model::Model& model);

}  // namespace plumbline::validation
