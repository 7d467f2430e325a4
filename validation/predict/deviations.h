// How well windows determine parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/predict/estimate.h"

namespace plumbline::validation {

/// Standard deviations with which the given windows and what is known beforehand determine n parameters. From
/// the scatter of the m windows' scores g (sandwich estimate), so that correlated residuals within a window
/// do not make them too small; what is known beforehand errs too, by as much as it says:
///   H^-1 (m/(m - n) sum g g' + P + sum s s') H^-1,  H = sum J'J + P,  P = diag(1/stated deviation^2)
/// + kPriorPrecision: what the data do not see is uncertain by ten search units.
/// A reading that never changes over a trial (of a locked joint) has one error of quantisation, the same in
/// all windows, where their scatter cannot show it: s is the sum of its rows of J.
/// Never below what white residuals of the present size would give, H^-1 times their mean square.
Eigen::VectorXd parameter_deviations(PredictorPool& pool, const std::vector<int>& windows,
                                     const std::vector<FreeParameter>& parameters, const Estimate& estimate,
                                     Eigen::MatrixXd* correlation);

}  // namespace plumbline::validation
