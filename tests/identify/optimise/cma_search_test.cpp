// The search without derivatives.
#include "validation/identify/optimise/cma_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::validation {
namespace {

// The minimum of an ellipsoid with a ratio of axes of 1000, turned against the axes.
TEST(CmaSearch, FindsTheMinimumOfANarrowEllipsoid) {
  const Eigen::Index n = 5;
  Eigen::VectorXd target(n);
  target << 1.0, -2.0, 0.5, 3.0, -1.0;
  const auto cost = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd d = x - target;
    double sum = std::pow(d.sum(), 2);
    for (Eigen::Index i = 0; i < n; ++i) {
      sum += std::pow(10.0, 6.0 * static_cast<double>(i) / static_cast<double>(n - 1)) *
             std::pow(d[i] - (i > 0 ? d[i - 1] : 0.0), 2);
    }
    return sum;
  };
  CmaSearch search(Eigen::VectorXd::Zero(n), 0.5, 0, 7);
  EXPECT_EQ(search.population(), 8);
  for (int generation = 0; generation < 600; ++generation) {
    const Eigen::MatrixXd candidates = search.ask();
    Eigen::VectorXd costs(candidates.cols());
    for (Eigen::Index k = 0; k < candidates.cols(); ++k) {
      costs[k] = cost(candidates.col(k));
    }
    search.tell(costs);
  }
  EXPECT_LT((search.mean() - target).norm(), 1e-6);
  EXPECT_LT(search.width(), 1e-3);
}

TEST(CmaSearch, CanBeRepeatedAndRefusesNonsense) {
  CmaSearch one(Eigen::VectorXd::Zero(3), 0.3, 0, 4), same(Eigen::VectorXd::Zero(3), 0.3, 0, 4),
      other(Eigen::VectorXd::Zero(3), 0.3, 0, 5);
  const Eigen::MatrixXd first = one.ask();
  EXPECT_EQ(first, same.ask());
  EXPECT_NE(first, other.ask());
  EXPECT_THROW(CmaSearch(Eigen::VectorXd(), 0.3, 0, 1), std::invalid_argument);
  EXPECT_THROW(CmaSearch(Eigen::VectorXd::Zero(2), 0.0, 0, 1), std::invalid_argument);
  EXPECT_THROW(CmaSearch(Eigen::VectorXd::Zero(2), 0.3, 3, 1), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::validation
