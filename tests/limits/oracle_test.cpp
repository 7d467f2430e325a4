// The whole chain from robot file to acceleration, against the leg bench's equations derived by hand.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "tests/limits/bench.h"
#include "tests/oracles/leg_bench_lagrangian.h"

namespace plumbline::limits {
namespace {

using oracles::Pair;

constexpr int kStates = 1000;
constexpr double kRelative = 1e-9;
const Pair kViscous(4.316e-3, 9.844e-3);  // Park et al. Table VII

class Draw {
 public:
  Pair pair(double size) { return Pair(one(size), one(size)); }
  double one(double size) { return std::uniform_real_distribution<double>(-size, size)(random_); }

 private:
  std::mt19937 random_{1};
};

/// Accelerations of thigh and shin from the plant, at thigh and shin angles that its locks allow.
Pair accelerations(model::Plant& plant, const Pair& angles, const Pair& rates, const Pair& torques) {
  const NamedMap named = named_map(plant, {"thigh", "shin"});
  const Eigen::Index nz = plant.positions();
  const auto solve = named.map.completeOrthogonalDecomposition();
  Eigen::VectorXd x(plant.states());
  x.head(nz) = solve.solve(angles - named.offset);
  x.tail(nz) = solve.solve(rates);
  Eigen::VectorXd xdot(plant.states());
  plant.rate(x.data(), torques.data(), xdot.data());
  return named.map * xdot.tail(nz);
}

TEST(Oracle, FreeLegAcceleratesAsDerivedByHand) {
  model::Plant plant(leg_bench(), {});
  ASSERT_EQ(plant.states(), 4);
  const oracles::LegBenchConstants leg = oracles::mabel_left_leg();
  Draw draw;
  for (int i = 0; i < kStates; ++i) {
    const Pair angles = draw.pair(3.0);
    const Pair rates = draw.pair(6.0);
    const Pair torques = draw.pair(5.0);
    const Pair expected = oracles::leg_bench_accelerations(leg, angles, rates, torques, kViscous);
    const Pair found = accelerations(plant, angles, rates, torques);
    ASSERT_LT((found - expected).norm(), kRelative * expected.norm())
        << "angles " << angles.transpose() << " found " << found.transpose() << " expected "
        << expected.transpose();
  }
}

void check_locked(int free_motor) {
  const model::Model model = leg_bench();
  const oracles::LegBenchConstants leg = oracles::mabel_left_leg();
  const std::string locked = free_motor == 0 ? "mLS" : "mLA";
  Draw draw;
  for (int at = 0; at < 20; ++at) {
    const double held = draw.one(1.0);  // leg shape or leg angle
    const double ratio = free_motor == 0 ? leg.leg_shape.ratio : leg.leg_angle.ratio;
    model::Plant plant(model, {{locked, ratio * held}});
    ASSERT_EQ(plant.states(), 2);
    for (int i = 0; i < kStates / 20; ++i) {
      const double moving = draw.one(2.0);
      const double speed = draw.one(6.0);
      const Pair angles =
          free_motor == 0 ? Pair(moving + held, moving - held) : Pair(held + moving, held - moving);
      const Pair rates = free_motor == 0 ? Pair(speed, speed) : Pair(speed, -speed);
      const Pair torques = draw.pair(5.0);
      const Pair expected =
          oracles::leg_bench_accelerations_locked(leg, free_motor, angles, rates, torques, kViscous);
      const Pair found = accelerations(plant, angles, rates, torques);
      ASSERT_LT((found - expected).norm(), kRelative * std::max(expected.norm(), 1e-2))
          << locked << " locked, found " << found.transpose() << " expected " << expected.transpose();
    }
  }
}

TEST(Oracle, LegShapeLockedAcceleratesAsDerivedByHand) { check_locked(0); }
TEST(Oracle, LegAngleLockedAcceleratesAsDerivedByHand) { check_locked(1); }

TEST(Oracle, StoredEnergyDiffersByAConstantOnly) {
  model::Plant plant(leg_bench(), {});
  const oracles::LegBenchConstants leg = oracles::mabel_left_leg();
  const NamedMap named = named_map(plant, {"thigh", "shin"});
  const Pair idle = Pair::Zero();
  Draw draw;
  double constant = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Pair angles = draw.pair(3.0);
    const Pair rates = draw.pair(6.0);
    Eigen::VectorXd x(4);
    x << named.map.lu().solve(angles - named.offset), named.map.lu().solve(rates);
    const double difference =
        plant.energetics(x.data(), idle.data()).stored - oracles::leg_bench_energy(leg, angles, rates);
    constant = i == 0 ? difference : constant;
    ASSERT_NEAR(difference, constant, 1e-9);
  }
}

}  // namespace
}  // namespace plumbline::limits
