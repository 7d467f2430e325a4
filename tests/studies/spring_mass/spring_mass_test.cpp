#include "validation/studies/spring_mass/spring_mass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "validation/studies/spring_mass/leg_placement.h"

namespace plumbline::spring_mass {
namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

double energy_of(const Body& body, const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) {
  const double stretch = position.norm() - body.rest_length;
  return 0.5 * body.mass * velocity.squaredNorm() + body.mass * body.gravity * position.z() +
         0.5 * body.stiffness * stretch * stretch;
}

TEST(SpringMass, VerticalBounceTakesTheTimeOfTheClosedForm) {
  // On a vertical leg m z'' = k (l0 - z) - m g is linear: half a swing and the two parts of the landing
  // speed.
  const Body body;
  const double apex = 1.1, speed = std::sqrt(2.0 * body.gravity * 0.1),
               omega = std::sqrt(body.stiffness / body.mass);
  Body standing = body;
  standing.energy = body.mass * body.gravity * apex;
  const Step made = step(standing, apex, {90.0 * degree, 0.0});
  ASSERT_EQ(made.ending, Ending::apex);
  const double expected = 2.0 / omega * (3.14159265358979323846 - std::atan(speed * omega / body.gravity));
  EXPECT_NEAR(made.stance, expected, 1e-10);
  EXPECT_NEAR(made.apex, apex, 1e-9);
}

TEST(SpringMass, StanceKeepsEnergyAndTheMomentAboutTheVerticalOfTheFoot) {
  const Body body;
  const Step made = step(body, 1.1, {60.0 * degree, 25.0 * degree});
  ASSERT_EQ(made.ending, Ending::apex);
  EXPECT_NEAR(energy_of(body, made.takeoff.position, made.takeoff.velocity), body.energy, 1e-6);
  const double before = made.touchdown.position.cross(made.touchdown.velocity).z();
  EXPECT_NEAR(made.takeoff.position.cross(made.takeoff.velocity).z(), before, 1e-9);
}

TEST(SpringMass, AStepRunBackwardsIsAStep) {
  // Time reversal: from the next apex with the leg as it was at take-off the mass comes back to the apex
  // before.
  const Body body;
  const Step there = step(body, 1.1, {61.0 * degree, 12.0 * degree});
  ASSERT_EQ(there.ending, Ending::apex);
  const Eigen::Vector3d off = there.takeoff.position;
  const double back_along = std::atan2(-there.takeoff.velocity.y(), -there.takeoff.velocity.x());
  const double foot_at = std::atan2(-off.y(), -off.x());
  const Step back = step(body, there.apex, {std::asin(off.z() / body.rest_length), foot_at - back_along});
  ASSERT_EQ(back.ending, Ending::apex);
  EXPECT_NEAR(back.apex, 1.1, 1e-8);
  EXPECT_NEAR(std::remainder(back.deflection + there.deflection, 2.0 * 3.14159265358979323846), 0.0, 1e-8);
}

TEST(SpringMass, LeftAndRightAreMirrorImages) {
  const Step left = step(Body{}, 1.05, {58.0 * degree, 20.0 * degree});
  const Step right = step(Body{}, 1.05, {58.0 * degree, -20.0 * degree});
  EXPECT_NEAR(left.apex, right.apex, 1e-12);
  EXPECT_NEAR(left.deflection, -right.deflection, 1e-12);
  EXPECT_LT(left.deflection, 0.0) << "a foot to the left pushes to the right";
}

TEST(SpringMass, WhatCannotGoOnSaysWhy) {
  EXPECT_EQ(step(Body{}, 0.8, {80.0 * degree, 0.0}).ending, Ending::stumbled);
  EXPECT_THROW(step(Body{}, 3.0, {80.0 * degree, 0.0}), std::invalid_argument);
}

TEST(SpringMass, TheSteadyGaitIsSteady) {
  const double attack = steady_attack(Body{}, 1.1);
  EXPECT_NEAR(step(Body{}, 1.1, {attack, 0.0}).apex, 1.1, 1e-9);
  const Step made = step(Body{}, 1.1, {attack, 0.0});
  EXPECT_NEAR(made.takeoff.position.x(), -made.touchdown.position.x(), 1e-8) << "a symmetric stance";
}

}  // namespace
}  // namespace plumbline::spring_mass
