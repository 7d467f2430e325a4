// How sure a least-squares estimate is, from windows of which some tell nothing.
#include "validation/identify/predict/cluster_scatter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <random>

namespace plumbline::validation {
namespace {

Reduced window(const Eigen::MatrixXd& J, const Eigen::VectorXd& r) {
  Reduced one;
  one.H = J.transpose() * J;
  one.g = J.transpose() * r;
  return one;
}

Scatter scatter_of(const std::vector<Reduced>& windows, Eigen::Index n) {
  return cluster_scatter(windows, 1e-9 * Eigen::MatrixXd::Identity(n, n), Eigen::MatrixXd::Zero(n, n));
}

// The mean of m numbers: variance s^2/m with s^2 = sum (y - mean)^2/(m - 1), of m - 1 degrees of freedom.
TEST(ClusterScatter, OfAMeanIsTheTextbooks) {
  Eigen::VectorXd y(5);
  y << 1.0, 2.5, 0.5, 3.0, 2.0;
  std::vector<Reduced> windows;
  for (const double value : y) {
    windows.push_back(window(Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Constant(1, value - y.mean())));
  }
  const Scatter scatter = scatter_of(windows, 1);
  EXPECT_NEAR(scatter.covariance(0, 0), (y.array() - y.mean()).square().sum() / 4.0 / 5.0, 1e-8);
  EXPECT_NEAR(scatter.freedom[0], 4.0, 1e-6);
}

TEST(ClusterScatter, WindowsThatTellNothingDoNotCount) {
  std::vector<Reduced> windows;
  for (const double value : {0.5, -1.0, 0.25, 0.25}) {
    windows.push_back(window(Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Constant(1, value)));
  }
  const Scatter few = scatter_of(windows, 1);
  windows.resize(40, window(Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Ones(1)));
  const Scatter many = scatter_of(windows, 1);
  EXPECT_NEAR(many.covariance(0, 0), few.covariance(0, 0), 1e-12);
  EXPECT_NEAR(many.freedom[0], few.freedom[0], 1e-9);
}

TEST(ClusterScatter, OneWindowSaysNothingOfHowSure) {
  const Scatter scatter = scatter_of({window(Eigen::MatrixXd::Ones(3, 1), Eigen::Vector3d(1, -2, 1))}, 1);
  EXPECT_EQ(scatter.freedom[0], 0.0);
}

TEST(ClusterScatter, WhatIsOnlyKnownBeforehandIsAsSureAsItSays) {
  const std::vector<Reduced> windows(6, window(Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Zero(1)));
  const Scatter scatter =
      cluster_scatter(windows, Eigen::MatrixXd::Constant(1, 1, 16.0), Eigen::MatrixXd::Zero(1, 1));
  EXPECT_NEAR(scatter.covariance(0, 0), 1.0 / 16.0, 1e-12);
  EXPECT_TRUE(std::isinf(scatter.freedom[0]));
}

// Twelve windows that tell, of unequal weight, and as many that do not; residuals with a common error in each
// window. Of 2000 draws a 95 % interval must hold the truth in 93 to 97 % (two-sided, four standard errors).
TEST(ClusterScatter, IntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kDraws = 2000;
  constexpr Eigen::Index kParameters = 4, kSamples = 6;
  std::mt19937_64 random(20260101);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(random); };
  std::vector<Eigen::MatrixXd> J;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(kParameters, kParameters);
  for (int w = 0; w < 24; ++w) {
    const double weight = w < 12 ? 1.0 + 0.2 * w : 0.0;
    J.emplace_back(weight * Eigen::MatrixXd::NullaryExpr(kSamples, kParameters, draw));
    H += J.back().transpose() * J.back();
  }
  int inside = 0;
  for (int i = 0; i < kDraws; ++i) {
    std::vector<Eigen::VectorXd> y;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(kParameters);
    for (const Eigen::MatrixXd& one : J) {
      const double common = 2.0 * draw();
      y.emplace_back(Eigen::VectorXd::NullaryExpr(kSamples, [&] { return common + draw(); }));
      sum += one.transpose() * y.back();
    }
    const Eigen::VectorXd found = H.ldlt().solve(sum);  // the truth is zero
    std::vector<Reduced> windows;
    for (std::size_t w = 0; w < J.size(); ++w) {
      windows.push_back(window(J[w], y[w] - J[w] * found));
    }
    const Scatter scatter = scatter_of(windows, kParameters);
    for (Eigen::Index p = 0; p < kParameters; ++p) {
      const boost::math::students_t student(scatter.freedom[p]);
      const double quantile = boost::math::quantile(student, 0.975);
      inside += std::abs(found[p]) < quantile * std::sqrt(scatter.covariance(p, p)) ? 1 : 0;
    }
  }
  const double share = static_cast<double>(inside) / static_cast<double>(kDraws * kParameters);
  EXPECT_GT(share, 0.93);
  EXPECT_LT(share, 0.97);
}

}  // namespace
}  // namespace plumbline::validation
