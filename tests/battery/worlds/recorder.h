// An experiment on a rig of a foreign world, and the trial that its sensors make of it.
#pragma once

#include <random>

#include "tests/battery/worlds/machine.h"
#include "validation/identify/twin/experiment.h"

namespace plumbline::battery::worlds {

struct Recording {
  Rig rig;
  std::vector<std::string> locked;
  Vector start;  ///< of the links' coordinates
  double period = 1e-3;
  Motion motion;
};

/// `mujoco`: the robot's name where MuJoCo plays it; empty: the equations by hand.
Recording record(const Rig& rig, const validation::Experiment& experiment, const model::Model& model,
                 const std::string& mujoco = "");

/// What a sensor shows: with noise, then in whole counts.
double counted(const Sensor& sensor, double value, std::mt19937_64& noise);

/// What the sensors show at sample k of a motion, each of it as late as it is: between samples by the cubic
/// that has their positions and rates.
Eigen::VectorXd readings_at(const Rig& rig, const Motion& motion, Eigen::Index k, double period);

/// In whole counts, with noise; locked motors where their own encoders show them.
validation::Trial trial_of(const Recording& recording, const validation::Experiment& experiment,
                           const model::Model& model, std::mt19937_64& noise);

}  // namespace plumbline::battery::worlds
