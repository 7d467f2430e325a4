// Search of a minimum without derivatives: covariance matrix adaptation.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace plumbline::validation {

/// CMA-ES with rank-one and rank-mu updates and cumulative step-size adaptation: N. Hansen, "The CMA
/// Evolution Strategy: A Tutorial" (arXiv 1604.00772), its equations and default constants. Only the order of
/// the costs counts. Deterministic for a seed.
class CmaSearch {
 public:
  /// From `start`, with standard deviation `width` along every axis. `population` 0: 4 + 3 ln(size).
  /// Throws std::invalid_argument for an empty start, a width that is not positive or a population below 4.
  CmaSearch(const Eigen::VectorXd& start, double width, int population, std::uint64_t seed);

  int population() const { return population_; }
  /// The next candidates, one a column.
  Eigen::MatrixXd ask();
  /// The cost of each candidate of the last ask.
  void tell(const Eigen::VectorXd& costs);

  const Eigen::VectorXd& mean() const { return mean_; }
  double width() const { return sigma_; }

 private:
  void adapt_path(const Eigen::VectorXd& step);
  void adapt_covariance(const Eigen::MatrixXd& steps);

  Eigen::Index n_;
  int population_, parents_;
  Eigen::VectorXd weights_;
  double mu_eff_, c_sigma_, d_sigma_, c_c_, c_1_, c_mu_, chi_;
  double sigma_;
  long generation_ = 0;
  bool stalled_ = false;  // the path of the step size is long: the rank-one update waits
  Eigen::VectorXd mean_, path_sigma_, path_c_;
  Eigen::MatrixXd C_, B_, candidates_;
  Eigen::VectorXd D_;  // square roots of C's eigenvalues
  std::mt19937_64 random_;
};

}  // namespace plumbline::validation
