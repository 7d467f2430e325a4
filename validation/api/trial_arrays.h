// A trial from arrays in memory, with the checks that a trial from files has.
#pragma once

#include <string>
#include <vector>

#include "simulator/trace/table.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::api {

/// A channel by the name of what it belongs to (a sensor, contact switch or motor), its unit, its values.
struct Channel {
  std::string name, unit;
  Eigen::VectorXd values;
};

/// A number by the name of a coordinate or motor, with its unit.
struct Held {
  std::string name, unit;
  double value = 0.0;
};

struct TrialArrays {
  std::string name;   ///< stands for the file in messages and results
  std::string title;  ///< empty: the name
  validation::Role role = validation::Role::train;
  Eigen::VectorXd time;  ///< s
  std::vector<Channel> measured;
  std::vector<Channel> commands;
  std::vector<Held> locked;
  std::vector<double> events;  ///< s, within the recording
};

/// Throws InputError (one line: trial, channel, found, expected) on unknown names, wrong units, arrays of
/// different length, NaN, times that do not rise, fewer than 20 samples, a contact switch that is neither 0
/// nor 1, events outside of the recording, and when no sensor was measured. Times that are not even (within
/// 1 %) are brought onto even samples, as those of a file are (validation/identify/trial/sampling.h).
validation::Trial trial_from(const TrialArrays& arrays, const model::Model& model);

}  // namespace plumbline::api
