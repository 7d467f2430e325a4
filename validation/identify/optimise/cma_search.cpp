#include "validation/identify/optimise/cma_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace plumbline::validation {
namespace {

int population_for(Eigen::Index n, int asked) {
  return asked > 0 ? asked : 4 + static_cast<int>(3.0 * std::log(static_cast<double>(n)));
}

}  // namespace

CmaSearch::CmaSearch(const Eigen::VectorXd& start, double width, int population, std::uint64_t seed)
    : n_(start.size()),
      population_(start.size() > 0 ? population_for(start.size(), population) : 0),
      parents_(population_ / 2),
      sigma_(width),
      mean_(start),
      random_(seed) {
  if (n_ == 0 || !(width > 0.0) || population_ < 4) {
    throw std::invalid_argument("a search needs a start, a positive width and a population of 4 or more");
  }
  const double n = static_cast<double>(n_);
  weights_.resize(parents_);
  for (int i = 0; i < parents_; ++i) {
    weights_[i] = std::log(0.5 * (population_ + 1)) - std::log(i + 1.0);
  }
  weights_ /= weights_.sum();
  mu_eff_ = 1.0 / weights_.squaredNorm();
  c_sigma_ = (mu_eff_ + 2.0) / (n + mu_eff_ + 5.0);
  d_sigma_ = 1.0 + 2.0 * std::max(0.0, std::sqrt((mu_eff_ - 1.0) / (n + 1.0)) - 1.0) + c_sigma_;
  c_c_ = (4.0 + mu_eff_ / n) / (n + 4.0 + 2.0 * mu_eff_ / n);
  c_1_ = 2.0 / ((n + 1.3) * (n + 1.3) + mu_eff_);
  c_mu_ = std::min(1.0 - c_1_, 2.0 * (mu_eff_ - 2.0 + 1.0 / mu_eff_) / ((n + 2.0) * (n + 2.0) + mu_eff_));
  chi_ = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
  path_sigma_ = path_c_ = Eigen::VectorXd::Zero(n_);
  C_ = B_ = Eigen::MatrixXd::Identity(n_, n_);
  D_ = Eigen::VectorXd::Ones(n_);
}

Eigen::MatrixXd CmaSearch::ask() {
  std::normal_distribution<double> normal;
  candidates_.resize(n_, population_);
  for (Eigen::Index k = 0; k < population_; ++k) {
    Eigen::VectorXd z(n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      z[i] = normal(random_);
    }
    candidates_.col(k) = mean_ + sigma_ * (B_ * D_.cwiseProduct(z));
  }
  return candidates_;
}

void CmaSearch::tell(const Eigen::VectorXd& costs) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(population_));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return costs[a] < costs[b]; });
  Eigen::MatrixXd steps(n_, parents_);
  for (Eigen::Index i = 0; i < parents_; ++i) {
    steps.col(i) = (candidates_.col(order[static_cast<std::size_t>(i)]) - mean_) / sigma_;
  }
  const Eigen::VectorXd step = steps * weights_;
  mean_ += sigma_ * step;
  ++generation_;
  adapt_path(step);
  adapt_covariance(steps);
  sigma_ *= std::exp(c_sigma_ / d_sigma_ * (path_sigma_.norm() / chi_ - 1.0));
}

void CmaSearch::adapt_path(const Eigen::VectorXd& step) {
  const double n = static_cast<double>(n_);
  const Eigen::VectorXd white = B_ * (B_.transpose() * step).cwiseQuotient(D_);
  path_sigma_ = (1.0 - c_sigma_) * path_sigma_ + std::sqrt(c_sigma_ * (2.0 - c_sigma_) * mu_eff_) * white;
  const double begun = 1.0 - std::pow(1.0 - c_sigma_, 2.0 * static_cast<double>(generation_));
  stalled_ = path_sigma_.norm() / std::sqrt(begun) > (1.4 + 2.0 / (n + 1.0)) * chi_;
  path_c_ *= 1.0 - c_c_;
  if (!stalled_) {
    path_c_ += std::sqrt(c_c_ * (2.0 - c_c_) * mu_eff_) * step;
  }
}

void CmaSearch::adapt_covariance(const Eigen::MatrixXd& steps) {
  const double held = stalled_ ? c_c_ * (2.0 - c_c_) : 0.0;
  C_ = (1.0 - c_1_ - c_mu_ + c_1_ * held) * C_ + c_1_ * path_c_ * path_c_.transpose() +
       c_mu_ * steps * weights_.asDiagonal() * steps.transpose();
  C_ = 0.5 * (C_ + C_.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(C_);
  B_ = eigen.eigenvectors();
  D_ = eigen.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
}

}  // namespace plumbline::validation
