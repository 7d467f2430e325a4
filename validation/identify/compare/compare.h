// Where a model fails: residual per channel, trial and window, in units and as share of the floor.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/compare/defects.h"
#include "validation/identify/compare/horizon.h"
#include "validation/identify/compare/phase_errors.h"
#include "validation/identify/compare/switch_timing.h"
#include "validation/identify/predict/lost_windows.h"

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
  // Of compare(model, data) only:
  std::vector<PhaseError> phases;
  std::vector<LostWindow> lost;  ///< not in any error
  std::vector<SwitchTiming> switches;
  // Of compare_with_curves only:
  std::vector<HorizonError> horizons;
  std::vector<Defect> defects;  ///< of the trials that are not of role test
  /// By trial, those of role test behind the others: samples x measured channels, SI; NaN where no window
  /// predicts.
  std::vector<Eigen::MatrixXd> predicted;
};

/// Predicts every window from its own estimated initial state with the model as it is, those of the tests
/// too. Nothing is fitted but these states and the zero errors that the trials grant (with_zero_errors).
/// Windows that cannot be integrated are left out and named.
Comparison compare(const model::Model& model, const Data& data);

/// The same with the predicted curves and the errors behind the windows' ends.
Comparison compare_with_curves(const model::Model& model, const Data& data);

/// The same from an estimate that is at hand, which was made with the model as it is given here.
Comparison compare(const model::Model& model, const Data& data, const Estimate& estimate);

}  // namespace plumbline::validation
