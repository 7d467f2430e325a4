// What an information matrix says of its parameters together.
#pragma once

#include <Eigen/Core>

#include "validation/studies/recipes/findings.h"

namespace plumbline::validation {

/// Worse is not known: a deviation as a share of the value. And the correlation that is worth a line.
inline constexpr double kWeakDirection = 0.5, kStrongCorrelation = 0.95;

/// Eigenvectors of H (information in relative units: one is the value itself) along which one standard
/// deviation is more than `most`; weakest first.
std::vector<WeakDirection> weak_directions(const Eigen::MatrixXd& H, const std::vector<std::string>& names,
                                           double most = kWeakDirection);

/// Pairs whose correlation, of the inverse of H, is beyond `least`; strongest first.
std::vector<StrongCorrelation> strong_correlations(const Eigen::MatrixXd& H,
                                                   const std::vector<std::string>& names,
                                                   double least = kStrongCorrelation);

}  // namespace plumbline::validation
