// In which part of the motion a model fails.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/compare/phases.h"
#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {

/// Residual (measured less predicted) of one channel over one phase of its motion.
struct PhaseError {
  std::string trial, channel, unit;
  Phase phase;
  double share = 0.0;  ///< of the trial's samples
  double rms = 0.0;    ///< SI
  double mean = 0.0;   ///< SI: above zero where more is measured than predicted
  double ratio = 0.0;  ///< rms / floor
};

/// Predictions of each trial from the estimate's parameters and initial states, samples x channels, SI; NaN
/// where no window predicts.
std::vector<Eigen::MatrixXd> predicted_traces(PredictorPool& pool,
                                              const std::vector<FreeParameter>& parameters,
                                              const Estimate& estimate);

/// For every channel and every phase that holds samples (phases.h), predicted from the estimate's parameters
/// and initial states.
std::vector<PhaseError> phase_errors(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                     const Estimate& estimate);

}  // namespace plumbline::validation
