// The hand-derived MABEL against its own energies: Lagrange's equations by central differences, and power.
#include "tests/oracles/mabel_lagrangian.h"

#include <gtest/gtest.h>

#include <random>

namespace plumbline::oracles {
namespace {

class MabelLagrangian : public ::testing::TestWithParam<bool> {
 protected:
  MabelVector draw(double reach) {
    MabelVector drawn;
    for (int i = 0; i < kMabelCoordinates; ++i) {
      drawn[i] = reach * std::uniform_real_distribution<double>(-1.0, 1.0)(generator_);
    }
    return drawn;
  }
  std::mt19937 generator_{7};
  const MabelOptions options_{true, GetParam()};
};

TEST_P(MabelLagrangian, MassMatrixIsThatOfTheKineticEnergy) {
  const MabelVector q = draw(1.0);
  const MabelVector v = draw(3.0);
  EXPECT_NEAR(0.5 * v.dot(mabel_mass_matrix(options_, q) * v) / mabel_kinetic(options_, q, v), 1.0, 1e-14);
}

TEST_P(MabelLagrangian, BiasObeysLagrange) {
  constexpr double kStep = 1e-4;
  for (int state = 0; state < 5; ++state) {
    const MabelVector q = draw(1.0);
    const MabelVector v = draw(2.0);
    const MabelVector bias = mabel_bias(options_, q, v);
    for (int i = 0; i < kMabelCoordinates; ++i) {
      const MabelVector unit = MabelVector::Unit(i);
      // dT/dv_i = T(v + e_i) - T(v) - T(e_i), exact because T is quadratic in v.
      const auto momentum = [&](const MabelVector& at) {
        return mabel_kinetic(options_, at, v + unit) - mabel_kinetic(options_, at, v) -
               mabel_kinetic(options_, at, unit);
      };
      const auto lagrangian = [&](const MabelVector& at) {
        return mabel_kinetic(options_, at, v) - mabel_potential(at);
      };
      const double drift = (momentum(q + kStep * v) - momentum(q - kStep * v)) / (2.0 * kStep);
      const double slope = (lagrangian(q + kStep * unit) - lagrangian(q - kStep * unit)) / (2.0 * kStep);
      EXPECT_NEAR(bias[i], drift - slope, 1e-5) << i;
    }
  }
}

TEST_P(MabelLagrangian, PowerBalances) {
  constexpr double kStep = 1e-6;
  const Eigen::Vector4d torques(3.0, -8.0, 2.0, 5.0);
  for (const bool stretch : {true, false}) {
    const MabelOptions options{stretch, GetParam()};
    MabelVector q = draw(0.5);
    MabelVector v = draw(2.0);
    if (!stretch) {
      q = mabel_without_stretch(q);
      v = mabel_without_stretch(v);
    }
    const MabelVector a = mabel_accelerations(options, q, v, torques);
    const auto energy = [&](double t) {
      return mabel_kinetic(options, q + t * v, v + t * a) + mabel_potential(q + t * v);
    };
    const double power = mabel_forces(options, q, v, torques).dot(v);
    EXPECT_NEAR((energy(kStep) - energy(-kStep)) / (2.0 * kStep), power, 1e-5 * std::abs(power) + 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Rotors, MabelLagrangian, ::testing::Values(false, true),
                         [](const auto& spin) { return spin.param ? "spin" : "relative"; });

}  // namespace
}  // namespace plumbline::oracles
