// The ground's LuGre friction against closed forms: steady sliding, the path law of rigid-plastic bristles, a
// turn, break-away, rest on a slope, and its energy on both sides of the passivity condition.
#include "contact/ground_friction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "tests/contact/values.h"
#include "tests/effects/rk4.h"

namespace plumbline::contact {
namespace {

using effects::rk4_step;
using effects::State;
using effects::Values;
using Eigen::Vector2d;

// Of the size that the literature uses for robots of this family.
constexpr double kSigma0 = 260.0, kSigma1 = 2.25, kAlpha0 = 1.71, kAlpha2 = 0.54;
constexpr double kRange = kAlpha0 / kSigma0;  // m, the bristles' deflection in steady sliding
constexpr double kNormal = 640.0, kGravity = 9.81;

class GroundFrictionTest : public testing::Test {
 protected:
  GroundFriction law;
  Values p = values(kSigma1, kAlpha2);

  Values values(double bristle_damping, double viscous) const {
    return values_of(law, {{"bristle_stiffness", kSigma0},
                           {"bristle_damping", bristle_damping},
                           {"friction", kAlpha0},
                           {"viscous", viscous}});
  }
  Vector2d bristle_rate(const Vector2d& slip, double normal, const Vector2d& d, const Values& q) const {
    Vector2d rate;
    law.state_rate(slip, normal, d.data(), q.data(), rate.data());
    return rate;
  }
  Vector2d force(const Vector2d& slip, const Vector2d& d) const {
    return law.force(slip, kNormal, d.data(), p.data());
  }
  /// Bristles after a slip that is given over time.
  Vector2d slide(const std::function<Vector2d(double)>& slip, double duration, int steps,
                 const Vector2d& d0 = Vector2d::Zero(), double normal = kNormal) const {
    const auto rate = [&](const State& x) {
      const Vector2d r = bristle_rate(slip(x[2]), normal, {x[0], x[1]}, p);
      return State{r.x(), r.y(), 1.0};
    };
    State x{d0.x(), d0.y(), 0.0};
    for (int i = 0; i < steps; ++i) x = rk4_step(rate, x, duration / steps);
    return {x[0], x[1]};
  }
  /// A foot of 1 kg under its weight, pulled by `pull(t)` (N) along `direction`: position (0, 1), velocity
  /// (2, 3), bristles (4, 5), time (6), path (7).
  effects::Rate pulled(const Vector2d& direction, double weight, std::function<double(double)> pull) const {
    return [this, direction, weight, pull = std::move(pull)](const State& x) {
      const Vector2d v(x[2], x[3]);
      const Vector2d d(x[4], x[5]);
      const Vector2d a = pull(x[6]) * direction + law.force(v, weight, d.data(), p.data());
      const Vector2d r = bristle_rate(v, weight, d, p);
      return State{v.x(), v.y(), a.x(), a.y(), r.x(), r.y(), 1.0, v.norm()};
    };
  }
};

State advance(const effects::Rate& rate, State x, double duration, double step) {
  const int steps = static_cast<int>(std::lround(duration / step));
  for (int i = 0; i < steps; ++i) x = rk4_step(rate, x, step);
  return x;
}

// Equations 30 to 32 with dd/dt = 0: |F| = (alpha_0 + alpha_2 |v|) N, against the slip.
TEST_F(GroundFrictionTest, SlidesSteadilyAgainstTheSlip) {
  for (const double speed : {1e-3, 0.1, 2.0}) {
    for (const double angle : {0.0, 1.0, 2.5, -2.0}) {
      const Vector2d e(std::cos(angle), std::sin(angle));
      const Vector2d d = slide([&](double) { return speed * e; }, 40 * kRange / speed, 4000);
      const Vector2d expected = -kNormal * (kAlpha0 + kAlpha2 * speed) * e;
      EXPECT_NEAR((force(speed * e, d) - expected).norm(), 0.0, 1e-8) << speed << " " << angle;
    }
  }
}

// Along a line the bristles know the path only: d = (alpha_0/sigma_0) (1 - exp(-sigma_0 x/alpha_0)), however
// fast; at first a spring of sigma_0 N per metre (Canudas de Wit et al. 1995; P. R. Dahl 1968).
TEST_F(GroundFrictionTest, BendsItsBristlesByThePath) {
  const double duration = 0.3;
  for (const double speed : {1e-4, 0.01, 0.5}) {
    const auto slip = [&](double t) { return Vector2d(speed * (1.0 + std::sin(20.0 * t)), 0.0); };
    const double path = speed * (duration + (1.0 - std::cos(20.0 * duration)) / 20.0);
    const Vector2d d = slide(slip, duration, 20000);
    EXPECT_NEAR(d.x(), kRange * -std::expm1(-path / kRange), 1e-9 * kRange) << speed;
    EXPECT_EQ(d.y(), 0.0);
  }
  const double path = 1e-7;
  const Vector2d d = slide([&](double) { return Vector2d(path, 0.0); }, 1.0, 100);
  const double stiffness = -force(Vector2d::Zero(), d).x() / path;
  EXPECT_NEAR(stiffness, kSigma0 * kNormal, 1e-5 * kSigma0 * kNormal);  // path/(2 range) = 8e-6 off
}

// After a right turn the old deflection fades with the path and the new one grows.
TEST_F(GroundFrictionTest, TurnsItsBristlesWithThePath) {
  const double path = 0.7 * kRange, speed = 0.05;
  const Vector2d d = slide([&](double) { return Vector2d(0.0, speed); }, path / speed, 2000, {kRange, 0.0});
  EXPECT_NEAR(d.x(), kRange * std::exp(-0.7), 1e-10);
  EXPECT_NEAR(d.y(), kRange * (1.0 - std::exp(-0.7)), 1e-10);
}

TEST_F(GroundFrictionTest, PrefersNoDirection) {
  const auto slip = [](double t) {
    return Vector2d(0.3 * std::sin(9.0 * t), 0.2 * std::cos(14.0 * t) - 0.05);
  };
  const Vector2d d = slide(slip, 0.5, 5000);
  const Vector2d f = force(slip(0.5), d);
  for (const double angle : {0.4, 1.5707963267948966, 3.0}) {
    const Eigen::Rotation2Dd turn(angle);
    const auto turned = [&](double t) { return Vector2d(turn * slip(t)); };
    const Vector2d g = force(turned(0.5), slide(turned, 0.5, 5000));
    EXPECT_NEAR((g - turn * f).norm(), 0.0, 1e-9 * f.norm()) << angle;
  }
}

// Below the coefficient of friction the foot stays, above it slides at the speed where alpha_2 v takes the
// rest.
TEST_F(GroundFrictionTest, BreaksAwayAtTheCoefficientOfFriction) {
  const double weight = kGravity;
  const auto at_share = [&](double share) {
    const auto ramp = [=](double t) { return share * kAlpha0 * weight * std::min(t, 1.0); };
    return advance(pulled({1.0, 0.0}, weight, ramp), State(8, 0.0), 8.0, 1e-3);
  };
  const State held = at_share(0.95);
  EXPECT_LT(std::abs(held[2]), 1e-9);
  EXPECT_NEAR(held[4], 0.95 * kRange, 1e-9);
  EXPECT_LT(held[0], 4.0 * kRange);  // quasi-static: -ln(1 - 0.95) = 3.0 ranges
  const State sliding = at_share(1.05);
  EXPECT_NEAR(sliding[2], 0.05 * kAlpha0 / kAlpha2, 1e-6);
}

// A foot set down on a slope. Near rest v' = g cos(slope) (mu - sigma_0 d - (sigma_1 (1 - s) + alpha_2) v)
// while it moves down (1 + s while up), s: the share of the friction used. So its speed dies at least as fast
// as exp(-g cos(slope) (sigma_1 (1 - s) + alpha_2) t/2), and at rest every d stays: no creep.
TEST_F(GroundFrictionTest, RestsOnASlope) {
  const double share = 0.5;
  const double slope = std::atan(share * kAlpha0);
  const double weight = kGravity * std::cos(slope);
  const Vector2d down(0.6, 0.8);
  const auto rate = pulled(down, weight, [&](double) { return kGravity * std::sin(slope); });
  const double decay = 0.5 * weight * (kSigma1 * (1.0 - share) + kAlpha2);
  const double fastest = std::sqrt(kSigma0 * weight) * kRange;  // natural frequency times full deflection
  State x(8, 0.0);
  for (int second = 1; second <= 10; ++second) {
    const State before = x;
    x = advance(rate, x, 1.0, 5e-4);
    const double creep = std::hypot(x[0] - before[0], x[1] - before[1]);
    // Roundoff of a position of 1e-2 m over 2,000 steps: below 1e-14.
    EXPECT_LT(creep, fastest * std::exp(-decay * (second - 1)) / decay + 1e-14) << second;
  }
  EXPECT_NEAR(x[4], share * kRange * down.x(), 1e-12);
  EXPECT_NEAR(x[5], share * kRange * down.y(), 1e-12);
  EXPECT_LT(std::hypot(x[2], x[3]), 1e-13);
}

// dx/dt - dd/dt = |v| s: shaken, LuGre creeps by the share of friction used of the path (Dupont et al. 2002).
TEST_F(GroundFrictionTest, CreepsUnderVibrationByAShareOfThePath) {
  const double weight = kGravity, share = 0.5;
  const auto pull = [&](double t) {
    return weight * kAlpha0 * (share + 0.02 * std::sin(2.0 * 3.141592653589793 * 30.0 * t));
  };
  const auto rate = pulled({1.0, 0.0}, weight, pull);
  const State before = advance(rate, State(8, 0.0), 2.0, 1e-4);
  const State after = advance(rate, before, 1.0, 1e-4);
  const double path = after[7] - before[7];
  EXPECT_GT(path, 1e-3);
  EXPECT_NEAR((after[0] - before[0]) / path, share,
              0.01 * share);  // s itself swings by some per cent of share
}

// Unloaded bristles straighten in their own time, whatever the foot does; so a foot lands with straight ones.
TEST_F(GroundFrictionTest, StraightensItsBristlesInTheAir) {
  const Vector2d bent(0.8 * kRange, -0.3 * kRange);
  const double tau = p[static_cast<std::size_t>(law.parameter_index("relaxation"))];
  const auto swing = [](double) { return Vector2d(3.0, -1.0); };
  const Vector2d d = slide(swing, 3.0 * tau, 1000, bent, 0.0);
  EXPECT_NEAR((d - std::exp(-3.0) * bent).norm(), 0.0, 1e-12);
  EXPECT_EQ(law.force({3.0, -1.0}, 0.0, bent.data(), p.data()).norm(), 0.0);
  EXPECT_EQ(law.stored_energy(0.0, bent.data(), p.data()), 0.0);
  EXPECT_EQ(law.dissipated_power({3.0, -1.0}, 0.0, bent.data(), p.data()), 0.0);
}

TEST_F(GroundFrictionTest, SlidesOnlyViscouslyWithoutFriction) {
  const Values q = values_of(law, {{"viscous", 0.1}});
  const Vector2d d(0.01, 0.02), v(2.0, -1.0);
  EXPECT_NEAR((law.force(v, 50.0, d.data(), q.data()) - Vector2d(-10.0, 5.0)).norm(), 0.0, 1e-12);
  EXPECT_LT(bristle_rate(v, 50.0, d, q).dot(d), 0.0);  // nothing holds the bristles bent
}

TEST_F(GroundFrictionTest, KeepsItsBristlesInRange) {
  for (int i = 0; i < 21; ++i) {
    const Vector2d edge = kRange * Vector2d(std::cos(0.3 * i), std::sin(0.3 * i));
    for (const double speed : {1e-4, 0.1, 5.0}) {
      for (const double normal : {0.0, kNormal}) {
        EXPECT_LE(bristle_rate({speed, 0.0}, normal, edge, p).dot(edge), 1e-15);
      }
    }
  }
}

// -F . v = d(stored energy)/dt + lost power at constant normal force; the rate of the energy is a central
// difference of a quadratic form, exact but for roundoff.
TEST_F(GroundFrictionTest, BalancesItsPowerAtConstantLoad) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const Vector2d v(unit(random), unit(random)), d(2.0 * kRange * unit(random), 2.0 * kRange * unit(random));
    const Vector2d rate = bristle_rate(v, kNormal, d, p);
    const double h = 1e-4;
    const Vector2d high = d + h * rate, low = d - h * rate;
    const double stored = (law.stored_energy(kNormal, high.data(), p.data()) -
                           law.stored_energy(kNormal, low.data(), p.data())) /
                          (2.0 * h);
    const double lost = law.dissipated_power(v, kNormal, d.data(), p.data());
    EXPECT_NEAR(-force(v, d).dot(v), stored + lost, 1e-9 * (1.0 + std::abs(lost) + std::abs(stored)));
  }
}

// In the range that the bristles never leave no energy comes back, however large the bristle damping. Outside
// it none does up to |v| = 4 alpha_0 (sigma_1 + alpha_2)/sigma_1^2, and some does beyond.
TEST_F(GroundFrictionTest, IsPassiveWhereTheNoteSaysSo) {
  const auto smallest_loss = [&](const Values& q, double speed, double largest_share) {
    double smallest = 1e300;
    for (int i = 0; i <= 1000; ++i) {
      const double size = 1e-3 * i * largest_share * kRange;
      for (int k = 0; k < 63; ++k) {
        const Vector2d d = size * Vector2d(std::cos(0.1 * k), std::sin(0.1 * k));
        smallest = std::min(smallest, law.dissipated_power({speed, 0.0}, kNormal, d.data(), q.data()));
      }
    }
    return smallest / (kNormal * speed);
  };
  for (const double bristle_damping : {0.0, kSigma1, 100.0 * kSigma1}) {
    for (const double speed : {1e-4, 0.1, 1.0, 30.0}) {
      EXPECT_GE(smallest_loss(values(bristle_damping, 0.0), speed, 1.0), -1e-12);
    }
  }
  const double bound = 4.0 * kAlpha0 * (kSigma1 + kAlpha2) / (kSigma1 * kSigma1);
  EXPECT_GE(smallest_loss(p, 0.999 * bound, 50.0), 0.0);
  EXPECT_LT(smallest_loss(p, 1.1 * bound, 50.0), -1e-3);
}

// Bent at a small load and let go at a large one, bristles give more than they took: (N2 - N1) sigma_0 d^2/2.
TEST_F(GroundFrictionTest, GivesEnergyWhenTheLoadRisesOnBentBristles) {
  const Values q = values(0.0, 0.0);
  const double path = 1e-5, speed = 1e-3, light = 100.0, heavy = 700.0;
  const auto rate_at = [&](double sign, double normal) {
    return [&, sign, normal](const State& x) {
      const Vector2d v(sign * speed, 0.0);
      const Vector2d d(x[0], 0.0);
      return State{bristle_rate(v, normal, d, q).x(), law.force(v, normal, d.data(), q.data()).dot(v)};
    };
  };
  State x = advance(rate_at(1.0, light), {0.0, 0.0}, path / speed, 1e-5);
  x = advance(rate_at(-1.0, heavy), x, path / speed, 1e-5);
  const double expected = 0.5 * (heavy - light) * kSigma0 * path * path;
  EXPECT_NEAR(x[1], expected, 0.01 * expected);  // the bristles slip by path/range = 0.15 %
  const Vector2d edge(kRange, 0.0);
  EXPECT_NEAR(law.stored_energy(1.0, edge.data(), q.data()), kAlpha0 * kAlpha0 / (2.0 * kSigma0), 1e-12);
}

// Under any load: work + stored energy + losses = what the changing load paid in.
TEST_F(GroundFrictionTest, BalancesItsEnergyUnderAChangingLoad) {
  const auto normal = [](double t) { return 500.0 + 300.0 * std::sin(17.0 * t); };
  const auto normal_rate = [](double t) { return 5100.0 * std::cos(17.0 * t); };
  const auto rate = [&](const State& x) {
    const double t = x[2];
    const Vector2d v(0.05 * std::sin(11.0 * t), 0.03 * std::cos(23.0 * t));
    const double n = normal(t);
    const Vector2d d(x[0], x[1]);
    const Vector2d r = bristle_rate(v, n, d, p);
    const double work = law.force(v, n, d.data(), p.data()).dot(v);
    const double lost = law.dissipated_power(v, n, d.data(), p.data());
    const double paid = law.stored_energy(n, d.data(), p.data()) * normal_rate(t) / n;
    return State{r.x(), r.y(), 1.0, work, lost, paid};
  };
  const State x = advance(rate, State(6, 0.0), 0.7, 1e-4);
  const double stored = law.stored_energy(normal(0.7), x.data(), p.data());
  EXPECT_GT(std::abs(x[5]), 0.01);  // the load's part is no trifle
  EXPECT_NEAR(x[3] + stored + x[4], x[5], 1e-8 * (std::abs(x[3]) + x[4]));
}

// A foot that rolls sideways feels nothing there, and forward what it felt before; in between, the power that
// the ground takes is that of the slip which is felt.
TEST_F(GroundFrictionTest, LateralIsTheShareOfTheSlipThatIsFelt) {
  Values rolling = p;
  rolling[static_cast<std::size_t>(law.parameter_index("lateral"))] = 0.0;
  const Vector2d d(0.004, 0.0);
  const Vector2d sideways = law.force({0.0, 0.7}, kNormal, Vector2d::Zero().eval().data(), rolling.data());
  EXPECT_EQ(sideways.norm(), 0.0);
  EXPECT_EQ(bristle_rate({0.0, 0.7}, kNormal, Vector2d::Zero(), rolling).norm(), 0.0);
  const Vector2d slanted = law.force({0.3, 0.7}, kNormal, d.data(), rolling.data());
  EXPECT_EQ(slanted, force({0.3, 0.0}, d));

  Values half = p;
  half[static_cast<std::size_t>(law.parameter_index("lateral"))] = 0.5;
  const Vector2d slip(0.2, -0.6);
  const Vector2d bent(0.003, -0.002);
  const double power = law.force(slip, kNormal, bent.data(), half.data()).dot(slip);
  EXPECT_NEAR(power, force({0.2, -0.3}, bent).dot(Vector2d(0.2, -0.3)), 1e-12 * std::abs(power));
}

}  // namespace
}  // namespace plumbline::contact
