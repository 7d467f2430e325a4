#include "validation/studies/recipes/information.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::validation {
namespace {

// Eigenvalues 400 and 0.01 along (1, 1) and (1, -1): the difference of the two is known to 1/sqrt(0.01) = 10.
Eigen::Matrix2d sum_is_known() {
  Eigen::Matrix2d H;
  H << 200.005, 199.995, 199.995, 200.005;
  return H;
}

TEST(WeakDirections, NamesTheCombinationThatIsNotKnown) {
  const std::vector<WeakDirection> weak = weak_directions(sum_is_known(), {"a", "b"}, 0.5);
  ASSERT_EQ(weak.size(), 1U);
  EXPECT_NEAR(weak[0].deviation, 10.0, 1e-6);
  ASSERT_EQ(weak[0].parts.size(), 2U);
  EXPECT_NEAR(std::abs(weak[0].parts[0].second), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(weak[0].parts[0].second, -weak[0].parts[1].second, 1e-9);
}

TEST(WeakDirections, AParameterWithoutInfluenceIsNotKnownAtAll) {
  Eigen::Matrix2d H;
  H << 100.0, 0.0, 0.0, 0.0;
  const std::vector<WeakDirection> weak = weak_directions(H, {"a", "b"}, 0.5);
  ASSERT_EQ(weak.size(), 1U);
  EXPECT_TRUE(std::isinf(weak[0].deviation));
  ASSERT_EQ(weak[0].parts.size(), 1U);
  EXPECT_EQ(weak[0].parts[0].first, "b");
}

// The inverse of [[p, q], [q, p]] is [[p, -q], [-q, p]]/(p^2 - q^2): correlation -q/p.
TEST(StrongCorrelations, AreThoseOfTheInverse) {
  const std::vector<StrongCorrelation> strong = strong_correlations(sum_is_known(), {"a", "b"}, 0.95);
  ASSERT_EQ(strong.size(), 1U);
  EXPECT_EQ(strong[0].one, "a");
  EXPECT_EQ(strong[0].other, "b");
  EXPECT_NEAR(strong[0].value, -199.995 / 200.005, 1e-9);
  EXPECT_TRUE(strong_correlations(Eigen::Matrix2d::Identity(), {"a", "b"}, 0.95).empty());
}

}  // namespace
}  // namespace plumbline::validation
