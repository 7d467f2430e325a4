// Meetings of shapes against elementary geometry, and against a search over the shapes' points.
#include "contact/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace plumbline::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Round ball(const Vector3d& centre, double radius) { return {centre, centre, radius}; }

void expect_meeting(const Meeting& met, const Vector3d& point, const Vector3d& normal, double depth) {
  EXPECT_LT((met.point - point).norm(), 1e-15) << met.point.transpose();
  EXPECT_LT((met.normal - normal).norm(), 1e-15) << met.normal.transpose();
  EXPECT_NEAR(met.depth, depth, 1e-15);
}

TEST(Shapes, BallsMeetOnTheLineOfTheirCentres) {
  expect_meeting(meet(ball({0.3, 0, 0}, 0.2), ball({0, 0, 0}, 0.15)), {0.125, 0, 0}, {1, 0, 0}, 0.05);
  expect_meeting(meet(ball({0, 0.4, 0}, 0.1), ball({0, 0, 0}, 0.1)), {0, 0.2, 0}, {0, 1, 0}, -0.2);
}

TEST(Shapes, ABallMeetsTheSideAndTheEndOfACapsule) {
  const Round rod{{0, 0, 0}, {1, 0, 0}, 0.1};
  expect_meeting(meet(ball({0.4, 0, 0.25}, 0.2), rod), {0.4, 0, 0.075}, {0, 0, 1}, 0.05);
  expect_meeting(meet(ball({1.3, 0, 0}, 0.2), rod), {1.1, 0, 0}, {1, 0, 0}, 0.0);
  expect_meeting(meet(rod, ball({-0.25, 0, 0}, 0.2)), {-0.075, 0, 0}, {1, 0, 0}, 0.05);
}

TEST(Shapes, CapsulesMeetWhereTheirLinesAreNearest) {
  const Round rod{{-1, 0, 0}, {1, 0, 0}, 0.1};
  expect_meeting(meet({{0.2, -1, 0.15}, {0.2, 1, 0.15}, 0.1}, rod), {0.2, 0, 0.075}, {0, 0, 1}, 0.05);
  // The end of one beside the other, and both ends.
  expect_meeting(meet({{0.5, 0.15, 0}, {0.5, 1, 0}, 0.1}, rod), {0.5, 0.075, 0}, {0, 1, 0}, 0.05);
  expect_meeting(meet({{1.2, 0, 0}, {2, 0.5, 0}, 0.15}, rod), {1.075, 0, 0}, {1, 0, 0}, 0.05);
  // Along each other: in the middle of what they share, from 0 to 1.
  expect_meeting(meet({{0, 0, 0.2}, {3, 0, 0.2}, 0.1}, rod), {0.5, 0, 0.1}, {0, 0, 1}, 0.0);
}

TEST(Shapes, ABallMeetsFacesEdgesAndCornersOfABox) {
  const Box box{Isometry3d::Identity(), {0.5, 0.4, 0.3}};
  expect_meeting(meet(ball({0.1, -0.2, 0.35}, 0.1), box), {0.1, -0.2, 0.275}, {0, 0, 1}, 0.05);
  const double s = std::sqrt(0.5);
  const Meeting edge = meet(ball({0.5 + 0.1 * s, 0, 0.3 + 0.1 * s}, 0.1), box);
  EXPECT_NEAR(edge.depth, 0.0, 1e-15);
  EXPECT_LT((edge.normal - Vector3d(s, 0, s)).norm(), 1e-15);
  const Meeting corner = meet(ball({0.6, -0.5, 0.4}, 0.2), box);
  EXPECT_NEAR(corner.depth, 0.2 - 0.1 * std::sqrt(3.0), 1e-15);
  EXPECT_LT((corner.normal - Vector3d(1, -1, 1).normalized()).norm(), 1e-15);
  // Its centre inside: out of the nearest face, and through the face without a jump.
  expect_meeting(meet(ball({0, 0.35, 0}, 0.1), box), {0, 0.325, 0}, {0, 1, 0}, 0.15);
  EXPECT_NEAR(meet(ball({0, 0.4 + 1e-12, 0}, 0.1), box).depth,
              meet(ball({0, 0.4 - 1e-12, 0}, 0.1), box).depth, 3e-12);
}

TEST(Shapes, PlanesAreMetByEndsAndCorners) {
  const Plane plane{{0, 0, 0.2}, {0, 0, 1}};
  expect_meeting(meet(ball({3, 4, 0.25}, 0.1), plane), {3, 4, 0.175}, {0, 0, 1}, 0.05);
  const Round rod{{0, 0, 0}, {1, 0, 0}, 0.1};
  const Box box{Isometry3d::Identity(), {0.5, 0.4, 0.3}};
  EXPECT_EQ(parts_that_meet(rod, plane).size(), 2U);
  EXPECT_EQ(parts_that_meet(box, plane).size(), 8U);
  EXPECT_EQ(parts_that_meet(ball({0, 0, 0}, 0.0), plane).size(), 1U);
  EXPECT_EQ(parts_that_meet(rod, ball({0, 0, 0}, 0.0)).size(), 1U);
  for (const auto& [one, other] :
       std::vector<std::pair<Shape, Shape>>{{rod, box},
                                            {box, rod},
                                            {box, box},
                                            {plane, plane},
                                            {plane, box},
                                            {ball({0, 0, 0}, 0.0), ball({1, 0, 0}, 0.0)}}) {
    EXPECT_TRUE(parts_that_meet(one, other).empty()) << name_of(one) << ", " << name_of(other);
  }
}

/// The least of a convex function over the cube [-1, 1]^n, by a search that halves its steps where none of
/// them leads down.
template <int n, typename Function>
double searched(const Function& distance) {
  using Point = Eigen::Matrix<double, n, 1>;
  Point best = Point::Zero();
  double least = distance(best);
  for (double reach = 1.0; reach > 1e-10;) {
    const Point middle = best;
    const double before = least;
    for (int i = 0; i < (n == 3 ? 27 : 9); ++i) {
      const Eigen::Vector3d all(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const Point at = (middle + reach * all.head<n>()).cwiseMax(-1.0).cwiseMin(1.0);
      if (distance(at) < least) {
        least = distance(at);
        best = at;
      }
    }
    reach *= least < before ? 1.0 : 0.5;
  }
  return least;
}

double searched_distance(const Vector3d& c, const Box& box) {
  return searched<3>([&](const Vector3d& at) { return (box.pose * at.cwiseProduct(box.half) - c).norm(); });
}

double searched_distance(const Round& one, const Round& other) {
  const auto along = [](const Round& rod, double at) {
    return Vector3d(0.5 * ((1.0 - at) * rod.from + (1.0 + at) * rod.to));
  };
  return searched<2>(
      [&](const Eigen::Vector2d& at) { return (along(one, at[0]) - along(other, at[1])).norm(); });
}

// Both distances are convex over the shape, so that the search cannot be caught elsewhere.
TEST(Shapes, AreAsDeepAsASearchFindsThem) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  const auto vector = [&]() { return Vector3d(spread(random), spread(random), spread(random)); };
  for (int trial = 0; trial < 200; ++trial) {
    const Round one{vector(), vector(), 0.1};
    const Round other{vector(), vector(), 0.2};
    EXPECT_NEAR(meet(one, other).depth, 0.3 - searched_distance(one, other), 1e-7);
    Box box;
    box.pose =
        Eigen::Translation3d(vector()) * Eigen::AngleAxisd(3.0 * spread(random), vector().normalized());
    box.half = 0.1 * Vector3d::Ones() + 0.5 * vector().cwiseAbs();
    const Vector3d c = box.pose * Vector3d(2.0 * vector());
    const double distance = searched_distance(c, box);
    if (distance > 1e-6) {
      EXPECT_NEAR(meet(ball(c, 0.1), box).depth, 0.1 - distance, 1e-7);
    }
  }
}

}  // namespace
}  // namespace plumbline::contact
