// Windows in which a model cannot be integrated at all.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// A window that was left out, where it is and what the integrator said.
struct LostWindow {
  std::string trial;
  double from = 0.0, to = 0.0;  ///< s
  std::string reason;
};

/// The data without the windows that the model, as it is, cannot be integrated through from where the
/// measurements begin. One that is lost costs this window, not the whole answer; which ones is told to
/// `lost`. Throws std::runtime_error, with the first reason and its trial, where none is left of a role.
Data without_lost(const model::Model& model, const Data& data, std::vector<LostWindow>& lost);

}  // namespace plumbline::validation
