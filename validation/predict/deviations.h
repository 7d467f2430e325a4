// How well windows determine parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/predict/estimate.h"

namespace plumbline::validation {

/// Standard deviations with which the given windows determine the parameters, from the windows' own scatter
/// (sandwich estimate over windows), so that correlated residuals within a window do not make them too small.
Eigen::VectorXd parameter_deviations(PredictorPool& pool, const std::vector<int>& windows,
                                     const std::vector<FreeParameter>& parameters, const Estimate& estimate,
                                     Eigen::MatrixXd* correlation);

}  // namespace plumbline::validation
