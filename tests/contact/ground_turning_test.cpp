// Rolling and spinning friction against closed forms: how a wheel rolls out and a top spins out, and that
// they only take energy.
#include "contact/ground_turning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/contact/values.h"
#include "tests/effects/rk4.h"

namespace plumbline::contact {
namespace {

using effects::rk4_step;
using effects::State;
using effects::Values;
using Eigen::Vector3d;

constexpr double kArm = 2e-3, kSpeed = 0.5, kNormal = 40.0, kInertia = 0.06;

/// Turn of a body of this inertia about every axis under a law's moment alone, `time` after w0.
Vector3d turns(const TurningLaw& law, const Values& p, const Vector3d& w0, double time) {
  const auto rate = [&](const State& x) {
    const Vector3d a = law.moment({x[0], x[1], x[2]}, kNormal, p.data()) / kInertia;
    return State{a.x(), a.y(), a.z()};
  };
  State x{w0.x(), w0.y(), w0.z()};
  const int steps = 4000;
  for (int i = 0; i < steps; ++i) x = rk4_step(rate, x, time / steps);
  return {x[0], x[1], x[2]};
}

/// dw/dt = -N r/I tanh(w/s) is separable: sinh(w/s) = sinh(w0/s) exp(-N r t/(I s)).
double left(double w0, double time) {
  return kSpeed * std::asinh(std::sinh(w0 / kSpeed) * std::exp(-kNormal * kArm * time / (kInertia * kSpeed)));
}

TEST(RollingFriction, ComesToRestAsTheClosedForm) {
  const auto law = rolling_friction();
  const Values p = values_of(*law, {{"arm", kArm}, {"roll_speed", kSpeed}});
  for (const double angle : {0.0, 1.0, 2.5, -2.0}) {
    const Vector3d e(std::cos(angle), std::sin(angle), 0.0);
    for (const double time : {0.5, 1.5, 3.0}) {
      const Vector3d w = turns(*law, p, 2.0 * e + Vector3d(0.0, 0.0, 3.0), time);
      EXPECT_LT((w - left(2.0, time) * e - Vector3d(0.0, 0.0, 3.0)).norm(), 1e-10) << angle << " " << time;
    }
  }
}

TEST(SpinningFriction, ComesToRestAsTheClosedForm) {
  const auto law = spinning_friction();
  const Values p = values_of(*law, {{"radius", kArm}, {"spin_speed", kSpeed}});
  for (const double time : {0.5, 1.5, 3.0}) {
    const Vector3d w = turns(*law, p, {1.0, -2.0, -2.0}, time);
    EXPECT_LT((w - Vector3d(1.0, -2.0, -left(2.0, time))).norm(), 1e-10) << time;
  }
}

TEST(TurningLaws, OnlyTakeEnergyAndAreNothingWithoutALoad) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(-3.0, 3.0);
  for (const auto& law : {rolling_friction(), spinning_friction()}) {
    const Values p = law->typical({});
    for (int i = 0; i < 200; ++i) {
      const Vector3d turn(draw(random), draw(random), draw(random));
      EXPECT_LT(law->moment(turn, kNormal, p.data()).dot(turn), 0.0);
      EXPECT_EQ(law->moment(turn, 0.0, p.data()).norm(), 0.0);
      EXPECT_EQ(law->moment(turn, kNormal, law->null_values().data()).norm(), 0.0);
    }
    EXPECT_EQ(law->moment(Vector3d::Zero(), kNormal, p.data()).norm(), 0.0);
  }
}

}  // namespace
}  // namespace plumbline::contact
