// The ground's smooth Coulomb friction against closed forms: how a block comes to rest, how fast it creeps
// down a slope, and that it only takes energy.
#include "contact/ground_coulomb.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "tests/contact/values.h"
#include "tests/effects/rk4.h"

namespace plumbline::contact {
namespace {

using effects::rk4_step;
using effects::State;
using effects::Values;
using Eigen::Vector2d;

constexpr double kMu = 0.3, kSlipSpeed = 0.02, kGravity = 9.81;

class GroundCoulombTest : public testing::Test {
 protected:
  GroundCoulomb law;
  Values p = values_of(law, {{"friction", kMu}, {"slip_speed", kSlipSpeed}});

  /// Velocity of a body of 1 kg under its weight, let go with v0, `time` later; `pull`, N, on it.
  Vector2d slides(const Vector2d& v0, double time, const Vector2d& pull = Vector2d::Zero(),
                  double weight = kGravity) const {
    const auto rate = [&](const State& x) {
      const Vector2d a = pull + law.force({x[0], x[1]}, weight, nullptr, p.data());
      return State{a.x(), a.y()};
    };
    State x{v0.x(), v0.y()};
    const int steps = 4000;
    for (int i = 0; i < steps; ++i) x = rk4_step(rate, x, time / steps);
    return {x[0], x[1]};
  }
};

// dv/dt = -mu g tanh(v/s) is separable: sinh(v/s) = sinh(v0/s) exp(-mu g t/s). In any direction of the plane.
TEST_F(GroundCoulombTest, ComesToRestAsTheClosedForm) {
  for (const double angle : {0.0, 1.0, 2.5, -2.0}) {
    const Vector2d e(std::cos(angle), std::sin(angle));
    for (const double time : {0.02, 0.05, 0.08}) {
      const double expected = kSlipSpeed * std::asinh(std::sinh(0.15 / kSlipSpeed) *
                                                      std::exp(-kMu * kGravity * time / kSlipSpeed));
      EXPECT_NEAR((slides(0.15 * e, time) - expected * e).norm(), 0.0, 1e-11) << angle << " " << time;
    }
  }
}

// On a slope it creeps where mu g cos tanh(v/s) = g sin, and slides away where the slope is steeper than mu.
TEST_F(GroundCoulombTest, CreepsDownASlopeAndSlidesDownASteepOne) {
  const Vector2d down(0.6, 0.8);
  const auto after = [&](double slope, double time) {
    return slides(Vector2d::Zero(), time, kGravity * std::sin(slope) * down, kGravity * std::cos(slope));
  };
  const double slope = std::atan(0.5 * kMu);
  EXPECT_NEAR((after(slope, 1.0) - kSlipSpeed * std::atanh(0.5) * down).norm(), 0.0, 1e-11);
  const double steep = std::atan(2.0 * kMu);
  const double growth = kGravity * (std::sin(steep) - kMu * std::cos(steep));
  EXPECT_NEAR((after(steep, 2.0) - after(steep, 1.0)).dot(down), growth, 1e-9);
}

// The slope of tanh at 0, and no division by it: at rest, and where the quotient's branches meet.
TEST_F(GroundCoulombTest, IsSmoothAtStandstill) {
  for (const double speed : {0.0, 1e-300, 1e-12, 1.9e-10, 2.1e-10, 1e-8}) {
    const Vector2d force = law.force({0.0, -speed}, 50.0, nullptr, p.data());
    EXPECT_NEAR(force.y(), 50.0 * kMu / kSlipSpeed * speed, 1e-12 * 50.0 * kMu / kSlipSpeed * speed);
    EXPECT_EQ(force.x(), 0.0);
  }
}

TEST_F(GroundCoulombTest, OnlyTakesEnergyAndBalancesItsPower) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const Values q = values_of(law, {{"friction", 1.0 + unit(random)},
                                     {"viscous", 1.0 + unit(random)},
                                     {"slip_speed", 0.02},
                                     {"lateral", 0.5 + 0.5 * unit(random)}});
    const Vector2d v = (i % 2 == 0 ? 1.0 : 0.01) * Vector2d(unit(random), unit(random));
    const double lost = law.dissipated_power(v, 120.0, nullptr, q.data());
    EXPECT_GE(lost, 0.0);
    EXPECT_NEAR(-law.force(v, 120.0, nullptr, q.data()).dot(v), lost, 1e-12 * lost);
  }
}

TEST_F(GroundCoulombTest, DoesNothingInTheAir) {
  EXPECT_EQ(law.force({0.3, -0.1}, 0.0, nullptr, p.data()).norm(), 0.0);
  EXPECT_EQ(law.dissipated_power({0.3, -0.1}, 0.0, nullptr, p.data()), 0.0);
}

// Its own oracle for `lateral`: what rolls sideways feels nothing there, and forward what it felt before.
TEST_F(GroundCoulombTest, RollsSidewaysWhereLateralIsZero) {
  Values rolling = p;
  rolling[static_cast<std::size_t>(law.parameter_index("lateral"))] = 0.0;
  const Vector2d force = law.force({0.5, 0.7}, 100.0, nullptr, rolling.data());
  EXPECT_NEAR(force.x(), -100.0 * kMu, 1e-12);  // tanh(25) is 1 to rounding
  EXPECT_EQ(force.y(), 0.0);
  EXPECT_TRUE(law.is_isotropic(p.data()));
  EXPECT_FALSE(law.is_isotropic(rolling.data()));
}

}  // namespace
}  // namespace plumbline::contact
