// Measured, predicted and residual over time, for one stage of a model.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/diagnose/screen.h"
#include "validation/report/thin.h"

namespace plumbline::validation {

/// Predictions of every window by trial: samples x channels, SI; NaN where there is no window.
std::vector<Eigen::MatrixXd> predicted_traces(const Stage& stage, const Data& data, const Progress& progress);

/// Indices of one trial's windows in the order of time, which is not the data's: there those in stance come
/// first.
std::vector<std::size_t> windows_in_time(const Data& data, std::size_t trial);
/// The same windows.
std::vector<Span> spans_of(const Data& data, std::size_t trial);

}  // namespace plumbline::validation
