// The hand-derived leg against bare kinematics: velocities by complex-step differentiation of the positions
// of the centres of mass, Lagrange's equations by central differences, and the balance of power.
#include "tests/oracles/leg_bench_lagrangian.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <complex>
#include <vector>

namespace plumbline::oracles {
namespace {

using Complex = std::complex<double>;
using ComplexPair = Eigen::Matrix<Complex, 2, 1>;

/// A body in the plane: centre of mass, orientation, mass and inertia about the centre of mass.
struct Placed {
  Complex x, z, angle;
  double mass, inertia;
};

Placed place(const PendulumLink& link, Complex pivot_x, Complex pivot_z, Complex angle) {
  // Rotation of (across, -along) counter-clockwise by the angle.
  const Complex x = pivot_x + link.across * std::cos(angle) + link.along * std::sin(angle);
  const Complex z = pivot_z + link.across * std::sin(angle) - link.along * std::cos(angle);
  return {x, z, angle, link.mass,
          link.inertia - link.mass * (link.along * link.along + link.across * link.across)};
}

std::vector<Placed> bodies(const LegBenchConstants& k, const ComplexPair& q) {
  const Complex hip = q[0];
  const Complex knee = q[1] - q[0];
  const Complex leg_angle = hip + 0.5 * knee;
  const Complex leg_shape = -0.5 * knee;
  const Complex zero = 0.0;
  return {place(k.thigh, zero, zero, hip),
          place(k.shin, k.thigh_length * std::sin(hip), -k.thigh_length * std::cos(hip), hip + knee),
          place(k.cspring, zero, 0.2, 2.0 * leg_shape),
          place(k.cshin, zero, zero, hip + knee),
          {zero, zero, k.leg_angle.ratio * leg_angle, 0.0, k.leg_angle.inertia},
          {zero, zero, k.leg_shape.ratio * leg_shape, 0.0, k.leg_shape.inertia}};
}

double kinetic(const LegBenchConstants& k, const Pair& q, const Pair& v) {
  constexpr double kStep = 1e-100;  // complex step: no cancellation
  const ComplexPair moved = q.cast<Complex>() + Complex(0.0, kStep) * v.cast<Complex>();
  double energy = 0.0;
  for (const Placed& body : bodies(k, moved)) {
    const double vx = body.x.imag() / kStep;
    const double vz = body.z.imag() / kStep;
    const double w = body.angle.imag() / kStep;
    energy += 0.5 * (body.mass * (vx * vx + vz * vz) + body.inertia * w * w);
  }
  return energy;
}

double potential(const LegBenchConstants& k, const Pair& q) {
  double energy = 0.0;
  for (const Placed& body : bodies(k, q.cast<Complex>())) {
    energy += body.mass * k.gravity * body.z.real();
  }
  return energy;
}

/// d/dt(dT/dv) - dT/dq + dV/dq without the acceleration's part.
Pair lagrange_bias(const LegBenchConstants& k, const Pair& q, const Pair& v) {
  constexpr double kStep = 1e-4;
  Pair bias;
  for (int i = 0; i < 2; ++i) {
    const Pair unit = Pair::Unit(i);
    // dT/dv_i = T(v + e_i) - T(v) - T(e_i), exact because T is quadratic in v.
    const auto momentum = [&](const Pair& at) {
      return kinetic(k, at, v + unit) - kinetic(k, at, v) - kinetic(k, at, unit);
    };
    const auto lagrangian = [&](const Pair& at) { return kinetic(k, at, v) - potential(k, at); };
    const double drift = (momentum(q + kStep * v) - momentum(q - kStep * v)) / (2.0 * kStep);
    const double slope = (lagrangian(q + kStep * unit) - lagrangian(q - kStep * unit)) / (2.0 * kStep);
    bias[i] = drift - slope;
  }
  return bias;
}

struct Motion {
  Pair q, v;
};

std::vector<Motion> motions() {
  return {{{0.0, 0.0}, {0.0, 0.0}},
          {{0.4, -0.3}, {0.0, 0.0}},
          {{-0.7, -1.5}, {2.0, -3.1}},
          {{1.1, 0.2}, {-4.0, 1.7}},
          {{2.9, 2.0}, {0.6, 5.0}}};
}

/// MABEL's leg with offsets across the links large enough to matter.
LegBenchConstants crooked_leg() {
  LegBenchConstants k = mabel_left_leg();
  k.thigh.across = 0.07;
  k.shin.across = -0.05;
  k.cspring.across = 0.04;
  k.cshin.across = -0.03;
  return k;
}

class LegBench : public ::testing::TestWithParam<bool> {
 protected:
  const LegBenchConstants k = GetParam() ? crooked_leg() : mabel_left_leg();
};

TEST_P(LegBench, MassMatrixIsThatOfTheKineticEnergy) {
  for (const Motion& m : motions()) {
    const Eigen::Matrix2d M = leg_bench_mass_matrix(k, m.q);
    const double cross =
        kinetic(k, m.q, Pair(1, 1)) - kinetic(k, m.q, Pair(1, 0)) - kinetic(k, m.q, Pair(0, 1));
    EXPECT_NEAR(M(0, 0), 2.0 * kinetic(k, m.q, Pair(1, 0)), 1e-13);
    EXPECT_NEAR(M(1, 1), 2.0 * kinetic(k, m.q, Pair(0, 1)), 1e-13);
    EXPECT_NEAR(M(0, 1), cross, 1e-13);
    EXPECT_NEAR(M(1, 0), cross, 1e-13);
    EXPECT_GT(M.determinant(), 0.0);
  }
}

TEST_P(LegBench, BiasObeysLagrange) {
  for (const Motion& m : motions()) {
    const Pair expected = lagrange_bias(k, m.q, m.v);
    const Pair actual = leg_bench_bias(k, m.q, m.v);
    // Central differences with h = 1e-4: relative truncation h^2 |v|^2/6, about 1e-7.
    EXPECT_NEAR(actual[0], expected[0], 1e-6);
    EXPECT_NEAR(actual[1], expected[1], 1e-6);
  }
}

TEST_P(LegBench, PowerBalances) {
  const Pair torques(0.7, -1.3);
  const Pair viscous(4.316e-3, 9.844e-3);
  constexpr double kStep = 1e-5;
  for (const Motion& m : motions()) {
    const Pair a = leg_bench_accelerations(k, m.q, m.v, torques, viscous);
    const double ahead = leg_bench_energy(k, m.q + kStep * m.v, m.v + kStep * a);
    const double behind = leg_bench_energy(k, m.q - kStep * m.v, m.v - kStep * a);
    const Pair w(k.leg_angle.ratio * (m.v[0] + m.v[1]) / 2.0, k.leg_shape.ratio * (m.v[0] - m.v[1]) / 2.0);
    const double power = torques.dot(w) - viscous.dot(w.cwiseProduct(w));
    EXPECT_NEAR((ahead - behind) / (2.0 * kStep), power, 1e-5);
  }
}

TEST_P(LegBench, EnergyIsKineticPlusPotential) {
  const double datum = potential(k, Pair::Zero()) - leg_bench_energy(k, Pair::Zero(), Pair::Zero());
  for (const Motion& m : motions()) {
    EXPECT_NEAR(leg_bench_energy(k, m.q, m.v) + datum, kinetic(k, m.q, m.v) + potential(k, m.q), 1e-12);
  }
}

TEST_P(LegBench, LockMeansZeroMotorAccelerationUnderTheLockTorque) {
  const Pair viscous(4.316e-3, 9.844e-3);
  for (int free_motor = 0; free_motor < 2; ++free_motor) {
    const Pair v = free_motor == 0 ? Pair(1.2, 1.2) : Pair(1.2, -1.2);
    const Pair q(0.5, -0.2);
    Pair torques(0.4, 0.9);
    const Pair locked = leg_bench_accelerations_locked(k, free_motor, q, v, torques, viscous);
    EXPECT_EQ((motor_map(k) * locked)[1 - free_motor], 0.0);
    // The torque that the lock adds follows from the equations of both coordinates; with it the free leg
    // accelerates alike.
    const Pair friction = viscous.cwiseProduct(motor_map(k) * v);
    const Pair needed =
        motor_map(k).transpose().inverse() * (leg_bench_mass_matrix(k, q) * locked + leg_bench_bias(k, q, v));
    EXPECT_NEAR((needed + friction)[free_motor], torques[free_motor], 1e-12);
    torques[1 - free_motor] = (needed + friction)[1 - free_motor];
    EXPECT_LT((leg_bench_accelerations(k, q, v, torques, viscous) - locked).norm(), 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Legs, LegBench, ::testing::Values(false, true),
                         [](const auto& leg) { return leg.param ? "crooked" : "mabel"; });

}  // namespace
}  // namespace plumbline::oracles
