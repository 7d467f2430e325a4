// Held points and impacts against closed forms.
#include "simulator/rigid/constraints.h"

#include <gtest/gtest.h>

namespace plumbline::rigid {
namespace {

constexpr double kMass = 3.0, kLength = 0.8, kGravity = 9.80665;
const double kInertia = kMass * kLength * kLength / 12.0;

struct Held {
  Eigen::MatrixXd M, J;
  Eigen::Vector3d h, bias;
};

/// A slender rod in the x-z plane: x and z of its middle, angle a from the level. With its left end held in
/// all three directions of the world, of which it can move in two: the end is at (x - L/2 cos a, z - L/2 sin
/// a).
Held held_at_left_end(double a, double w) {
  const double x = 0.5 * kLength * std::cos(a);
  const double z = 0.5 * kLength * std::sin(a);
  Held it;
  it.M = Eigen::Vector3d(kMass, kMass, kInertia).asDiagonal();
  it.J.resize(3, 3);
  it.J << 1.0, 0.0, z, 0.0, 0.0, 0.0, 0.0, 1.0, -x;
  it.h << 0.0, kMass * kGravity, 0.0;
  it.bias << w * w * x, 0.0, w * w * z;
  return it;
}

// A level rod let go with one end held: a'' = 3 g/(2 L), and a quarter of its weight at the pin.
TEST(Constraints, HoldARodByItsEnd) {
  const Held it = held_at_left_end(0.0, 0.0);
  Constraints constraints;
  constraints.set(it.M, it.J);
  EXPECT_EQ(constraints.rank(), 2);
  const Constraints::Motion motion = constraints.hold(-it.h, it.bias);
  EXPECT_NEAR(motion.acceleration[2], -1.5 * kGravity / kLength, 1e-11);
  EXPECT_NEAR(motion.reaction[2], 0.25 * kMass * kGravity, 1e-11);
  EXPECT_NEAR(motion.reaction[0], 0.0, 1e-11);
}

// Turning about the pin: the pin pulls with m w^2 L/2 besides.
TEST(Constraints, PullWhatTurnsAboutThem) {
  const double w = 2.5;
  const Held it = held_at_left_end(0.0, w);
  Constraints constraints;
  constraints.set(it.M, it.J);
  const Constraints::Motion motion = constraints.hold(-it.h, it.bias);
  EXPECT_NEAR(motion.reaction[0], -kMass * w * w * kLength / 2.0, 1e-11);
  EXPECT_NEAR(motion.reaction[2], 0.25 * kMass * kGravity, 1e-11);
}

// A level rod that falls at speed u and is caught at one end: about that end its angular momentum stays, so
// that a' = -3 u/(2 L), the impulse is m u/4 and a quarter of the energy is lost.
TEST(Constraints, CatchARodThatFalls) {
  const double u = 1.7;
  const Held it = held_at_left_end(0.0, 0.0);
  Constraints constraints;
  constraints.set(it.M, it.J);
  const Constraints::Impact impact = constraints.strike(Eigen::Vector3d(0.0, -u, 0.0));
  EXPECT_NEAR(impact.velocity[2], -1.5 * u / kLength, 1e-11);
  EXPECT_NEAR(impact.impulse[2], 0.25 * kMass * u, 1e-11);
  EXPECT_NEAR(impact.lost, 0.25 * 0.5 * kMass * u * u, 1e-11);
}

TEST(Constraints, ShareWhatTwoEqualRowsHold) {
  const Held it = held_at_left_end(0.3, 0.0);
  Eigen::MatrixXd twice(6, 3);
  twice << it.J, it.J;
  Constraints once, both;
  once.set(it.M, it.J);
  both.set(it.M, twice);
  EXPECT_EQ(both.rank(), once.rank());
  const Constraints::Motion one = once.hold(-it.h, Eigen::VectorXd::Zero(3));
  const Constraints::Motion two = both.hold(-it.h, Eigen::VectorXd::Zero(6));
  EXPECT_TRUE(two.acceleration.isApprox(one.acceleration, 1e-12));
  EXPECT_NEAR(two.reaction[2], 0.5 * one.reaction[2], 1e-11);
}

TEST(Constraints, RefuseWhatIsNoMassMatrix) {
  Constraints constraints;
  EXPECT_THROW(constraints.set(-Eigen::MatrixXd::Identity(2, 2), Eigen::MatrixXd::Zero(1, 2)),
               std::invalid_argument);
  EXPECT_THROW(constraints.set(Eigen::MatrixXd::Identity(2, 2), Eigen::MatrixXd::Zero(1, 3)),
               std::invalid_argument);
}

TEST(FootLoad, IsInItsConeOrNot) {
  const FootLoad load = foot_load({3.0, 4.0, 10.0});
  EXPECT_DOUBLE_EQ(load.normal, 10.0);
  EXPECT_DOUBLE_EQ(load.needed_friction(), 0.5);
  EXPECT_TRUE(load.holds(0.5));
  EXPECT_FALSE(load.holds(0.49));
  EXPECT_TRUE(foot_load({0.0, 0.0, -1.0}).lifts());
  // On a slope of 45 deg a vertical force lies on the cone of coefficient 1.
  const double s = std::sqrt(0.5);
  EXPECT_NEAR(foot_load({0.0, 0.0, 5.0}, {s, 0.0, s}).needed_friction(), 1.0, 1e-12);
}

}  // namespace
}  // namespace plumbline::rigid
