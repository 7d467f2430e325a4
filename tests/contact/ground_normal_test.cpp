// The normal law against hand calculations with Table VIII of Park et al. (2011), closed forms of impact
// (Hunt and Crossley 1975; Marhefka and Orin 1999) and the asymptotics of oscillators with root damping
// (Vazquez 2003).
#include "contact/ground_normal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/contact/values.h"
#include "tests/effects/rk4.h"

namespace plumbline::contact {
namespace {

using effects::rk4_step;
using effects::State;
using effects::Values;

// Table VIII.
constexpr double kStiffness = 4.38e7, kDamping = 3.0e6, kRootDamping = 4.5e6, kExponent = 1.5;
constexpr double kGravity = 9.81;
constexpr double kRobotMass = 65.0;  // Park et al. (2011), on one foot

class GroundNormalTest : public testing::Test {
 protected:
  GroundNormal law;
  Values table_eight =
      values_of(law, {{"stiffness", kStiffness}, {"damping", kDamping}, {"root_damping", kRootDamping}});
  Values hunt_crossley = values_of(law, {{"stiffness", kStiffness}, {"damping", kDamping}});

  /// Of a mass whose state is depth and rate.
  effects::Rate falling(double mass, double gravity, const Values& p) const {
    return [this, mass, gravity, p](const State& x) {
      return State{x[1], gravity - law.force(x[0], x[1], p.data()) / mass};
    };
  }
};

// 0.01^1.5 = 1e-3, sqrt(0.25) = 0.5: elastic 43,800 N, damping 750 N, root 2,250 N.
TEST_F(GroundNormalTest, GivesTheForcesOfTableEightAgainstTheMotion) {
  const auto force = [&](double depth, double rate) { return law.force(depth, rate, table_eight.data()); };
  EXPECT_NEAR(force(0.01, 0.0), 43800.0, 1e-7);
  EXPECT_NEAR(force(0.01, 0.25), 43800.0 + 3000.0, 1e-7);
  EXPECT_NEAR(force(0.01, -0.25), 43800.0 - 3000.0, 1e-7);
  EXPECT_EQ(force(0.0, 1.0), 0.0);
  EXPECT_EQ(force(-0.01, 1.0), 0.0);
}

TEST_F(GroundNormalTest, NeverPulls) {
  EXPECT_EQ(law.force(0.01, -100.0, table_eight.data()), 0.0);
  for (int i = 1; i <= 400; ++i) {
    EXPECT_GE(law.force(0.01, -0.1 * i, table_eight.data()), 0.0);
  }
}

TEST_F(GroundNormalTest, StatesItsCoefficientsAtAnyReference) {
  // At 1 mm and 4 m/s the same ground has (1e-3)^1.5 of the coefficients and twice of that for the root.
  const double share = std::pow(1e-3, 1.5);
  const Values other = values_of(law, {{"stiffness", kStiffness * share},
                                       {"damping", kDamping * share},
                                       {"root_damping", 2.0 * kRootDamping * share},
                                       {"reference_depth", 1e-3},
                                       {"root_speed", 4.0}});
  for (const double rate : {-0.5, 0.0, 0.7}) {
    const double expected = law.force(0.002, rate, table_eight.data());
    EXPECT_NEAR(law.force(0.002, rate, other.data()), expected, 1e-12 * expected);
  }
  EXPECT_NEAR(law.stored_energy(0.002, other.data()), law.stored_energy(0.002, table_eight.data()), 1e-12);
}

TEST_F(GroundNormalTest, StoresTheWorkOfItsElasticForce) {
  for (const double exponent : {1.0, 1.5, 2.0, 3.0}) {
    const Values p = values_of(law, {{"stiffness", 1e5}, {"exponent", exponent}});
    for (const double depth : {-0.01, 1e-3, 0.02}) {
      const double h = 1e-6;  // central difference: h^2/depth^2 = 1e-6 of the force
      const double slope =
          (law.stored_energy(depth + h, p.data()) - law.stored_energy(depth - h, p.data())) / (2 * h);
      const double force = law.force(depth, 0.0, p.data());
      EXPECT_NEAR(slope, force, 2e-6 * force) << exponent << " " << depth;
    }
  }
}

TEST_F(GroundNormalTest, LosesEnergyWheneverItMoves) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> depths(-0.002, 0.01), rates(-30.0, 10.0);
  for (int i = 0; i < 2000; ++i) {
    const double depth = depths(random), rate = rates(random);
    const double lost = law.dissipated_power(depth, rate, table_eight.data());
    EXPECT_GE(lost, 0.0);
    const double elastic = law.force(depth, 0.0, table_eight.data());
    const double taken = law.force(depth, rate, table_eight.data()) * rate;
    EXPECT_NEAR(taken, elastic * rate + lost, 1e-12 * (1.0 + std::abs(elastic * rate)));
  }
}

// A particle of mass m without gravity, a = damping/stiffness: m v dv/dz = -z^n (k + k a v) separates into
// v dv/(1 + a v) = -(k/m) z^n dz. Way in and way out share the depth, so with G(v) = v/a - ln(1 + a v)/a^2
//   G(v_in) = G(-v_out) = k z_max^(n+1)/(m (n+1)),  that is  a (v_in + v_out) = ln((1 + a v_in)/(1 - a
//   v_out)).
// (Marhefka and Orin, IEEE Trans. Systems, Man and Cybernetics A 29(6), 1999.)
TEST_F(GroundNormalTest, ReboundsWithTheClosedFormOfMarhefkaAndOrin) {
  const double a = kDamping / kStiffness;
  const double mass = 2.0;
  const auto potential = [&](double v) { return v / a - std::log1p(a * v) / (a * a); };
  const auto rebound = [&](double v_in) {  // by bisection; G(-v) grows from 0 without bound up to v = 1/a
    double low = 0.0, high = std::min(v_in, 1.0 / a);
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (potential(-middle) < potential(v_in) ? low : high) = middle;
    }
    return low;
  };
  for (const double v_in : {0.1, 0.5, 1.0, 3.0, 10.0, 30.0}) {
    const double z_max =
        std::pow(potential(v_in) * mass * (kExponent + 1) / kStiffness, 1.0 / (kExponent + 1.0));
    const auto rate = falling(mass, 0.0, hunt_crossley);
    State x{0.0, v_in};
    double deepest = 0.0;
    const double step = 1e-4 * z_max / v_in;
    int steps = 0;
    do {
      x = rk4_step(rate, x, step);
      deepest = std::max(deepest, x[0]);
    } while (x[0] > 0.0 && ++steps < 1000000);
    ASSERT_LE(x[0], 0.0) << "no rebound from " << v_in;
    // The force has an unbounded second derivative at the surface: errors of step^2.5 there, 1e-10; the
    // deepest sample misses the turning point by (1e-4)^2.
    EXPECT_NEAR(-x[1], rebound(v_in), 1e-7 * v_in) << v_in;
    EXPECT_NEAR(deepest, z_max, 1e-6 * z_max) << v_in;
  }
  // Hunt and Crossley (1975): e = 1 - (2/3) a v_in for slow impacts, up to (a v_in)^2.
  EXPECT_NEAR(rebound(0.1) / 0.1, 1.0 - 2.0 / 3.0 * a * 0.1, a * a * 0.01);
  EXPECT_LT(rebound(1e3), 1.0 / a);  // no rebound is faster than stiffness/damping
}

TEST_F(GroundNormalTest, BalancesEnergyOverBounces) {
  const auto motion = falling(kRobotMass, kGravity, table_eight);
  const auto rate = [&](const State& x) {
    State r = motion(x);
    r.push_back(law.dissipated_power(x[0], x[1], table_eight.data()));
    return r;
  };
  const double height = 0.02;
  State x{-height, 0.0, 0.0};
  const double before = kRobotMass * kGravity * height;
  double largest_stored = 0.0;
  for (int i = 0; i < 40000; ++i) {  // 0.4 s, several bounces
    x = rk4_step(rate, x, 1e-5);
    const double stored = law.stored_energy(x[0], table_eight.data());
    largest_stored = std::max(largest_stored, stored);
    const double energy = 0.5 * kRobotMass * x[1] * x[1] - kRobotMass * kGravity * x[0] + stored;
    // Fixed steps of 1e-5 s across corners of the force, contacts of 1e-2 s: 1e-6 and to spare.
    ASSERT_NEAR(energy + x[2], before, 1e-5 * before) << i;
  }
  EXPECT_GT(x[2], 0.2 * before);
  EXPECT_GT(largest_stored, 0.7 * before);
}

// A standing foot: the rest depth z0, the spring rate K and the root coefficient C there.
class StandingFootTest : public GroundNormalTest {
 protected:
  const double z0 = std::pow(kRobotMass * kGravity / kStiffness, 1.0 / kExponent);
  const double spring = kExponent * kStiffness * std::pow(z0, kExponent - 1.0);
  const double frequency = std::sqrt(spring / kRobotMass);
  const double amplitude0 = 0.05 * z0;  // small: the spring is straight to second order
  const double step = 1e-5;

  double amplitude(const State& x) const {
    return std::sqrt(std::pow(x[0] - z0, 2) + std::pow(x[1] / frequency, 2));
  }
  State settle(const Values& p, State x, double duration) const {
    const auto rate = falling(kRobotMass, kGravity, p);
    const int steps = static_cast<int>(std::lround(duration / step));
    for (int i = 0; i < steps; ++i) x = rk4_step(rate, x, step);
    return x;
  }
  bool turns(const Values& p, State x, double duration) const {
    const auto rate = falling(kRobotMass, kGravity, p);
    const double sign = x[1];
    const int steps = static_cast<int>(std::lround(duration / step));
    for (int i = 0; i < steps; ++i) {
      x = rk4_step(rate, x, step);
      if (x[1] * sign < 0.0) return true;
    }
    return false;
  }
};

// Mean loss of C |v|^1.5 over a cycle of amplitude A: dA/dt = -b sqrt(A), b = (C/m) mean|cos|^1.5/sqrt(w), so
// the oscillation ends at 2 sqrt(A0)/b. mean|cos|^1.5 = Gamma(5/4)/(sqrt(pi) Gamma(7/4)).
TEST_F(StandingFootTest, StopsBouncingInFiniteTimeWithRootDamping) {
  const Values p = values_of(law, {{"stiffness", kStiffness}, {"root_damping", kRootDamping}});
  const double root = kRootDamping * std::pow(z0, kExponent);
  const double mean = std::tgamma(1.25) / (std::sqrt(std::acos(-1.0)) * std::tgamma(1.75));
  const double b = root / kRobotMass * mean / std::sqrt(frequency);
  const double end = 2.0 * std::sqrt(amplitude0) / b;
  for (const double share : {0.2, 0.4, 0.6}) {
    const State x = settle(p, {z0 + amplitude0, 0.0}, share * end);
    // Averaging holds while C sqrt(w A) is small beside K A; it is 0.23 of it at the last of these.
    EXPECT_NEAR(std::sqrt(amplitude(x) / amplitude0), 1.0 - share, 0.02) << share;
  }
  EXPECT_TRUE(turns(p, settle(p, {z0 + amplitude0, 0.0}, 0.5 * end), 0.2 * end));
  EXPECT_FALSE(turns(p, settle(p, {z0 + amplitude0, 0.0}, 1.1 * end), 2.0 * end));
}

// What is left then creeps: K x = C sqrt(-v) gives d(1/x)/dt = (K/C)^2, not an arrival in finite time.
TEST_F(StandingFootTest, CreepsToItsDepthAsOneOverTime) {
  const double root = kRootDamping * std::pow(z0, kExponent);
  const State early = settle(table_eight, {z0 + amplitude0, 0.0}, 0.4);
  const State late = settle(table_eight, early, 0.4);
  const double x1 = early[0] - z0, x2 = late[0] - z0;
  const double growth = (1.0 / std::abs(x2) - 1.0 / std::abs(x1)) / 0.4;
  EXPECT_GT(x1 * x2, 0.0);
  EXPECT_NEAR(growth, std::pow(spring / root, 2), 0.01 * growth);
}

// The root term ends at 1e-9 m/s within 2 s; without it the speed decays as exp(-damping z0^n/(2m) t) and is
// still a million times that.
TEST_F(StandingFootTest, RestsMuchSoonerThanWithoutTheRoot) {
  const double duration = 2.0;
  const State with = settle(table_eight, {z0 + amplitude0, 0.0}, duration);
  EXPECT_LT(std::abs(with[1]), 1e-9);
  const double decay = kDamping * std::pow(z0, kExponent) / (2.0 * kRobotMass);
  for (const double time : {0.5 * duration, duration}) {
    const State without = settle(hunt_crossley, {z0 + amplitude0, 0.0}, time);
    EXPECT_NEAR(std::log(amplitude(without) / amplitude0), -decay * time, 0.01);
    EXPECT_GT(frequency * amplitude(without), 1e-3);
  }
}

TEST_F(GroundNormalTest, SwitchesWhereItsForceBends) {
  const auto switches = [&](double depth, double rate, const Values& p) {
    std::vector<double> g{7.0};  // appended to what is there
    law.switches(depth, rate, p.data(), g);
    EXPECT_EQ(g.size(), 4U);
    EXPECT_EQ(g[0], 7.0);
    return g;
  };
  EXPECT_LT(switches(-0.01, 1.0, table_eight)[1], 0.0);
  EXPECT_GT(switches(0.01, 1.0, table_eight)[1], 0.0);
  EXPECT_LT(switches(0.01, -1.0, table_eight)[2], 0.0);
  EXPECT_GT(switches(-0.01, -1.0, table_eight)[2], 0.0);    // turning in the air is no event
  EXPECT_GT(switches(0.01, -1.0, hunt_crossley)[2], 0.0);   // nor without a root
  EXPECT_GT(switches(0.01, -14.5, hunt_crossley)[3], 0.0);  // the ground lets go at 4.38e7/3e6 = 14.6 m/s
  EXPECT_LT(switches(0.01, -14.7, hunt_crossley)[3], 0.0);
}

}  // namespace
}  // namespace plumbline::contact
