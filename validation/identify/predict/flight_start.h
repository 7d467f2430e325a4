// Where a recording begins that begins in flight: from its samples before the first touchdown.
#pragma once

#include <Eigen/Core>

#include "validation/identify/predict/windows.h"

namespace plumbline::validation {

/// Samples from `first` on, before `end`, in which no foot is in the ground, as the sensors say; 0 for a
/// model without feet or a motion that begins on the ground.
Eigen::Index samples_in_flight(Predictor& predictor, Eigen::Index first, Eigen::Index end);

/// State at the start of a window of the trial. Where a foot lands within it, and no contact switch and no
/// stated start tells, least squares of the model's motion in flight against the samples before the first
/// touchdown (five at least),
///   min over x0 of |r(x0)|^2,  r: residuals in floors,
/// by Gauss-Newton steps. In flight this is nearly linear, and it depends on nothing that the ground does; a
/// polynomial over a fixed number of samples would reach into the impact. Else, and where a step does not
/// help, Predictor::initial_state().
Eigen::VectorXd state_at_start(Predictor& predictor, const Trial& trial, const Window& window);

}  // namespace plumbline::validation
