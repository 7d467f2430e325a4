// How well windows determine parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {

struct Precision {
  Eigen::VectorXd deviations;    ///< one standard deviation of each parameter
  Eigen::VectorXd below, above;  ///< the same to either side, where it is searched (to_search)
  Eigen::VectorXd freedom;       ///< degrees of freedom behind each: windows that do not tell it do not count
  Eigen::MatrixXd correlation;   ///< a zero on the diagonal: the data do not depend on the parameter
  Eigen::MatrixXd inverse{};     ///< H^-1, search units
};

/// From the scatter of the windows' scores (cluster_scatter.h), so that correlated residuals within a window
/// do not make the deviations too small; what is known beforehand errs, too, by as much as it says:
/// the precision of Prior + kPriorPrecision (what the data do not see is uncertain by ten search units).
/// A reading that never changes over a trial (of a locked joint) has one error of quantisation, the same in
/// all windows, where their scatter cannot show it: its score is the sum of its rows of J.
/// Never below what white residuals of the present size would give, H^-1 times their mean square.
Precision precision_of(PredictorPool& pool, const std::vector<int>& windows,
                       const std::vector<FreeParameter>& parameters, const Estimate& estimate);

/// How the deviations of the parameters hang together, for a model file; none of those that the data do not
/// depend on, and none whose label two have.
model::Correlations correlations_of(const std::vector<FreeParameter>& parameters,
                                    const Eigen::VectorXd& theta, const Precision& precision);

}  // namespace plumbline::validation
