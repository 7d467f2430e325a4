// How far off a prediction is after a while, in the units in which people speak of a task.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {

/// Seconds after the last measurement that the prediction knows.
const std::vector<double>& usual_horizons();  // 0.05, 0.1, 0.5, 2

/// Root mean square error of one channel so long after the last measurement.
struct HorizonError {
  std::string trial, channel;
  std::string unit;  ///< deg, mm or N
  Role role = Role::train;
  double horizon = 0.0;  ///< s
  double rms = 0.0;      ///< in `unit`
  int windows = 0;       ///< behind it
  int lost = 0;          ///< windows from whose end the model could not be integrated so far
};

/// The motion that was estimated on each window goes on behind the window's end with the recorded commands:
///   e(h) = sqrt(mean over windows of (measured - predicted)^2 at h seconds behind the window's last sample).
/// The prediction knows the measurements of its window (0.5 s unless said otherwise) and none after it. A
/// window counts for a horizon that ends within the recording with no event (Trial::events) on the way;
/// horizons without any window are left out. `estimate`: of the pool's model with these parameters.
std::vector<HorizonError> horizon_errors(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                         const Estimate& estimate,
                                         const std::vector<double>& horizons = usual_horizons());

}  // namespace plumbline::validation
