// How the uncertainties of a model's values hang together.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumbline::model {

/// Values that were identified together are uncertain together: where a recording tells the product of a mass
/// and a gain, both may be wrong by a tenth, but not either alone. With the stated standard deviations s_i
/// the covariance of two values is s_i s_j matrix(i, j); values that are not listed are independent of all
/// others.
struct Correlations {
  std::vector<std::string> of{};  ///< labels, "viscous@mLA:damping"
  Eigen::MatrixXd matrix{};       ///< symmetric, positive definite, ones on the diagonal

  bool empty() const { return of.empty(); }
  /// Rows and columns of these labels, in this order.
  Eigen::MatrixXd among(const std::vector<std::string>& labels) const;
  /// The others alone.
  Correlations without(const std::vector<std::string>& labels) const;
};

/// Both, independent of each other; no value in both.
Correlations joined(const Correlations& a, const Correlations& b);

/// As close to `matrix` as a file of few digits can say it and still be positive definite: (C + e I)/(1 + e)
/// with e = 1e-4. Entries that are not finite count as 0.
Eigen::MatrixXd writable_correlation(const Eigen::MatrixXd& matrix);

}  // namespace plumbline::model
