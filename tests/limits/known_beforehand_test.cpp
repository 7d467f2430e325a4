// What a window is not free to choose: bristles that follow the measured motion, parameters that are known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/limits/bench.h"
#include "validation/identify/predict/estimate.h"

namespace plumbline::limits {
namespace {

using validation::FreeParameter;

// At constant speed a bristle without Stribeck rise follows dz/dt = v - (sigma_0 |v| / F_C) z, so
// z = F_C/sigma_0 (1 - exp(-sigma_0 |v| t / F_C)) sign(v) (Canudas de Wit et al. 1995, equation 2).
TEST(CarriedBristle, FollowsTheClosedFormAtConstantSpeed) {
  const double level = 0.05;
  const double stiffness = 2.0;
  const model::Model model =
      with_effect(leg_bench(), "lugre", "mLA", {level, 0.0, 1.0, stiffness, 0.01, 0.0});
  const model::Plant plant(model, {});
  const std::vector<int> bristles = plant.carried_states();
  ASSERT_EQ(bristles.size(), 1U);
  Eigen::VectorXd from = Eigen::VectorXd::Zero(plant.states());
  from[plant.positions()] = -0.3;
  const double v = plant.velocity_of("mLA", from.data());
  ASSERT_GT(std::abs(v), 0.01);
  const double h = 1e-3;
  const Eigen::VectorXd idle = Eigen::VectorXd::Zero(plant.motors());
  Eigen::VectorXd x = from;
  for (int k = 1; k <= 40; ++k) {
    Eigen::VectorXd to = from;
    to[0] = from[0] + h * from[plant.positions()];
    plant.carry_states(from.data(), to.data(), idle.data(), h, x.data());
    from = to;
    const double expected =
        std::copysign(level / stiffness, v) * (1.0 - std::exp(-stiffness * std::abs(v) * k * h / level));
    EXPECT_NEAR(x[bristles[0]], expected, 1e-9) << k;
  }
}

// A bristle that is a thousand times faster than the sample must end at its steady deflection, not swing.
TEST(CarriedBristle, IsStableWhenStiff) {
  const model::Model model = with_effect(leg_bench(), "lugre", "mLA", {0.05, 0.0, 1.0, 1e6, 0.01, 0.0});
  const model::Plant plant(model, {});
  Eigen::VectorXd at = Eigen::VectorXd::Zero(plant.states());
  at[plant.positions()] = 0.5;
  const double v = plant.velocity_of("mLA", at.data());
  Eigen::VectorXd x = at;
  const Eigen::VectorXd idle = Eigen::VectorXd::Zero(plant.motors());
  for (int k = 0; k < 5; ++k) {
    plant.carry_states(at.data(), at.data(), idle.data(), 1e-3, x.data());
    EXPECT_NEAR(x[plant.carried_states()[0]], std::copysign(0.05 / 1e6, v), 1e-10);
  }
}

// A mass on a spring on a link that is held rings down as x0 exp(-zeta w t) cos(w' t) (but for the sine of
// size zeta; Den Hartog, section 2.7): two states that act on each other. Each on its own would grow by a
// quarter.
TEST(CarriedResonator, RingsDownAsTheClosedFormSays) {
  const double frequency = 6.0;
  const double zeta = 0.01;
  const model::Model model = with_effect(leg_bench(), "resonator", "leg_angle", {0.02, frequency, zeta});
  const model::Plant plant(model, {});
  const std::vector<int> states = plant.carried_states();
  ASSERT_EQ(states.size(), 2U);
  const Eigen::VectorXd idle = Eigen::VectorXd::Zero(plant.motors());
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(plant.states());
  Eigen::VectorXd x = still;
  x[states[0]] = 0.01;
  const double w = 2.0 * 3.14159265358979323846 * frequency;
  const double damped = w * std::sqrt(1.0 - zeta * zeta);
  for (int k = 1; k <= 300; ++k) {
    plant.carry_states(still.data(), still.data(), idle.data(), 1e-3, x.data());
    const double t = 1e-3 * k;
    const double expected =
        0.01 * std::exp(-zeta * w * t) * (std::cos(damped * t) + zeta * w / damped * std::sin(damped * t));
    EXPECT_NEAR(x[states[0]], expected, 1e-4) << k;
  }
}

// A lag of first order under a command that holds: torque = u (1 - exp(-t / tau)), behind a gain that it
// follows.
TEST(CarriedLag, FollowsTheCommandsAndNotTheWindow) {
  constexpr double kTau = 0.02;
  constexpr double kGain = 1.25;
  model::Model model = with_effect(leg_bench(), "torque_constant_error", "mLA", {kGain});
  model = with_effect(model, "actuator_lag", "mLA", {kTau});
  const model::Plant plant(model, {});
  const std::vector<int> states = plant.carried_states();
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(plant.carried_state_effects().size(), 2U) << "the gain before the lag decides, too";
  const int motor = model.motor_index("mLA");
  Eigen::VectorXd command = Eigen::VectorXd::Zero(plant.motors());
  command[motor] = 0.7;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const Eigen::VectorXd still = x;
  for (int k = 1; k <= 30; ++k) {
    plant.carry_states(still.data(), still.data(), command.data(), 1e-3, x.data());
    const double expected =
        kGain * plant.torque_gain(motor) * command[motor] * (1.0 - std::exp(-1e-3 * k / kTau));
    EXPECT_NEAR(x[states[0]], expected, 1e-6 * std::abs(expected)) << k;
  }
}

/// Estimates the damping at mLA, three standard deviations off in the model, of noise-free data.
double damping_with(double deviation) {
  const model::Model model = leg_bench();
  model::Model truth = model;
  const double stated = model.effects[0].values[0].value;
  truth.effects[0].values[0].value = 1.3 * stated;
  validation::Trial train = validation::twin(truth, both_motors(truth, 1.5), {});
  train.role = validation::Role::train;
  const validation::Data data({train}, {});
  validation::PredictorPool pool(model, data);
  FreeParameter damping;
  damping.upper = 1.0;
  damping.typical = stated;
  damping.mean = stated;
  damping.deviation = deviation * stated;
  const validation::Estimate found =
      validation::gauss_newton(pool, {damping}, Eigen::VectorXd::Constant(1, stated), {}, {10, 1e-6});
  return found.theta[0] / stated;
}

TEST(Prior, WeighsWhatIsKnownAgainstTheData) {
  const double free = damping_with(std::numeric_limits<double>::infinity());
  EXPECT_NEAR(free, 1.3, 0.03);
  EXPECT_NEAR(damping_with(10.0), free, 1e-3) << "hardly anything is known";
  EXPECT_NEAR(damping_with(1e-6), 1.0, 1e-4) << "it is known exactly";
  const double between = damping_with(0.002);
  EXPECT_GT(between, 1.001);
  EXPECT_LT(between, free - 0.001);
}

}  // namespace
}  // namespace plumbline::limits
