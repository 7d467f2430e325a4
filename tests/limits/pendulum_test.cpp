// A geared pendulum from a URDF swings with the period of the closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/limits/bench.h"

namespace plumbline::limits {
namespace {

// tests/robots/pendulum: arm, gear and rotor.
constexpr double kMass = 1.2;          // kg
constexpr double kLever = 0.3;         // m
constexpr double kArmInertia = 0.036;  // about the centre of mass, kg m^2
constexpr double kRatio = 50.0;
constexpr double kRotor = 3.3e-5;  // kg m^2
constexpr double kGravity = 9.80665;

/// Shoulder inertia: the rotor counts with the square of the ratio.
constexpr double kInertia = kMass * kLever * kLever + kArmInertia + kRatio * kRatio * kRotor;

/// T = 4 sqrt(I/(m g l)) K(sin(a/2)), K the complete elliptic integral of the first kind (Landau and
/// Lifshitz, Mechanics, section 11, problem 1).
double period(double amplitude) {
  return 4.0 * std::sqrt(kInertia / (kMass * kGravity * kLever)) *
         std::comp_ellint_1(std::sin(0.5 * amplitude));
}

model::Model frictionless() {
  model::Model model = model::read_model(std::string(PLUMBLINE_ROOT) + "/tests/robots/pendulum/model.yaml",
                                         effects::Catalogue::all());
  model.effects.clear();
  return model;
}

struct Swing {
  std::vector<double> bottoms;  // times at which it passes the bottom, s
  double top_speed = 0.0;       // rad/s
  double energy_error = 0.0;    // J
};

Swing swing(double amplitude) {
  model::Model model = frictionless();
  // A spring of negligible stiffness, whose rest is the bottom: its switching function marks the passes.
  model = with_effect(model, "unilateral_spring", "shoulder", {1e-30, 0.0, 0.0, 1.0, 1e-3});
  model::Plant plant(model, {});
  const NamedMap named = named_map(plant, {"shoulder"});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  x[0] = amplitude / named.map(0, 0);
  const Eigen::MatrixXd idle = Eigen::MatrixXd::Zero(1, 6001);
  const run::CommandedRun run = run::run_commands(plant, x, idle, 1e-3, 0.0, {}, nullptr, options_at(1e-11));
  Swing result;
  for (const integrate::Event& event : run.events) {
    result.bottoms.push_back(event.time);
  }
  result.top_speed = (named.map(0, 0) * run.states.row(1)).cwiseAbs().maxCoeff();
  result.energy_error = std::abs(run.energy_error);
  return result;
}

class Amplitude : public testing::TestWithParam<double> {};

TEST_P(Amplitude, SwingsWithThePeriodOfTheClosedForm) {
  const double amplitude = GetParam();
  const Swing found = swing(amplitude);
  const double T = period(amplitude);
  ASSERT_GE(found.bottoms.size(), 3U);
  for (std::size_t i = 0; i < found.bottoms.size(); ++i) {
    EXPECT_NEAR(found.bottoms[i], (0.25 + 0.5 * static_cast<double>(i)) * T, 1e-8 * T) << "pass " << i;
  }
  std::printf("amplitude %.1f rad: period %.9f s, expected %.9f s\n", amplitude,
              found.bottoms[2] - found.bottoms[0], T);
}

TEST_P(Amplitude, TurnsHeightIntoSpeed) {
  const double amplitude = GetParam();
  const Swing found = swing(amplitude);
  const double height = kLever * (1.0 - std::cos(amplitude));
  const double speed = std::sqrt(2.0 * kMass * kGravity * height / kInertia);
  EXPECT_NEAR(found.top_speed, speed, 1e-5 * speed);  // the fastest sample is up to half a period off
  EXPECT_LE(found.top_speed, speed * (1.0 + 1e-9));
  EXPECT_LT(found.energy_error, 1e-9 * kMass * kGravity * height);
}

INSTANTIATE_TEST_SUITE_P(Pendulum, Amplitude, testing::Values(0.1, 1.0, 2.5, 3.0));

}  // namespace
}  // namespace plumbline::limits
