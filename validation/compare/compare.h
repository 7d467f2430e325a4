// Where a model fails: residual per channel, trial and window, in units and as share of the floor.
#pragma once

#include <string>
#include <vector>

#include "validation/compare/phase_errors.h"
#include "validation/compare/switch_timing.h"
#include "validation/predict/lost_windows.h"

namespace plumbline::validation {

struct ChannelError {
  std::string trial, name, unit;
  Role role = Role::train;
  double rms = 0.0;    ///< SI
  double floor = 0.0;  ///< SI
  double ratio = 0.0;  ///< rms / floor
};

struct WindowError {
  std::string trial;
  double from = 0.0, to = 0.0;  ///< s
  double ratio = 0.0;           ///< root mean square over the channels, floor units
  std::string worst_channel;
};

struct Comparison {
  std::vector<ChannelError> channels;
  std::vector<WindowError> windows;  ///< worst first
  Scores scores;
  std::vector<PhaseError> phases;      ///< of compare(model, data) only
  std::vector<LostWindow> lost;        ///< of compare(model, data) only: not in any error
  std::vector<SwitchTiming> switches;  ///< of compare(model, data) only
};

/// Predicts every window from its own estimated initial state with the model as it is (nothing fitted), those
/// of the tests too. Windows that cannot be integrated are left out and named.
Comparison compare(const model::Model& model, const Data& data);

/// The same from an estimate that is at hand.
Comparison compare(const model::Model& model, const Data& data, const Estimate& estimate);

}  // namespace plumbline::validation
