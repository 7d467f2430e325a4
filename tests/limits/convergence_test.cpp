// Compliance, lag and stops in the limits where closed forms or the rigid model say what must come out.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/limits/bench.h"

namespace plumbline::limits {
namespace {

constexpr double kTolerance = 1e-9;

run::CommandedOptions quiet() {
  run::CommandedOptions options = options_at(kTolerance);
  options.energy = false;
  return options;
}

/// Slope of log(error) over log(parameter) between neighbours.
void expect_order(const std::vector<double>& parameter, const std::vector<double>& error, double order) {
  for (std::size_t i = 1; i < error.size(); ++i) {
    const double slope = std::log(error[i] / error[i - 1]) / std::log(parameter[i] / parameter[i - 1]);
    std::printf("%10.3g: error %.3e, order %.3f\n", parameter[i], error[i], slope);
    EXPECT_NEAR(slope, order, 0.15) << "between " << parameter[i - 1] << " and " << parameter[i];
  }
}

// A stiff stretch follows its load: x = -f/K to first order, the error of the rigid model falls as 1/K.
TEST(Convergence, CableStretchBecomesRigidAsItsStiffnessGrows) {
  const model::Model rigid = leg_bench();
  const validation::Experiment experiment = both_motors(rigid, 0.5);
  const run::CommandedRun reference = simulate(rigid, experiment, quiet());
  const std::vector<double> stiffness = {3e2, 3e3, 3e4};
  std::vector<double> error;
  for (const double K : stiffness) {
    const double damping = 2.0 * std::sqrt(K * 5e-4);  // about critical for the rotor, 5e-4 kg m^2
    const model::Model soft = with_effect(rigid, "cable_stretch", "leg_angle", {K, damping});
    error.push_back(largest_difference(simulate(soft, experiment, quiet()), reference));
  }
  expect_order(stiffness, error, -1.0);
}

// A first-order lag T delays a slow command by T: the error falls in proportion.
TEST(Convergence, ActuatorLagVanishesWithItsTimeConstant) {
  const model::Model rigid = leg_bench();
  const validation::Experiment experiment = both_motors(rigid, 0.5);
  const run::CommandedRun reference = simulate(rigid, experiment, quiet());
  const std::vector<double> constants = {1e-3, 2.5e-4, 6.25e-5};
  std::vector<double> error;
  for (const double T : constants) {
    const model::Model slow = with_effect(rigid, "actuator_lag", "mLA", {T});
    error.push_back(largest_difference(simulate(slow, experiment, quiet()), reference));
  }
  expect_order(constants, error, 1.0);
}

/// The course of a coordinate between samples, by Hermite's cubic over the sample that holds t.
double position_at(const model::Model& model, const run::CommandedRun& run, const std::string& name,
                   double t) {
  const model::Plant plant(model, {});
  const double h = run.time[1] - run.time[0];
  const auto k = std::min(static_cast<Eigen::Index>(t / h), run.time.size() - 2);
  const double s = (t - run.time[k]) / h;
  const double p0 = plant.position_of(name, run.states.col(k).data());
  const double p1 = plant.position_of(name, run.states.col(k + 1).data());
  const double v0 = plant.velocity_of(name, run.states.col(k).data());
  const double v1 = plant.velocity_of(name, run.states.col(k + 1).data());
  return (1 + 2 * s) * (1 - s) * (1 - s) * p0 + s * (1 - s) * (1 - s) * h * v0 + s * s * (3 - 2 * s) * p1 -
         s * s * (1 - s) * h * v1;
}

TEST(Convergence, HardStopIsMetWhereItBegins) {
  const model::Model bare = leg_bench();
  const validation::Experiment experiment = both_motors(bare, 1.0);
  const run::CommandedRun free = simulate(bare, experiment, quiet());
  const effects::Scales scales = scales_of(bare, free, effects::Place::coordinate, "thigh");
  const double wall = scales.center + 0.4 * scales.position;
  // Stiffness and damping such that the leg enters and leaves; no root, whose kinks are switches of their
  // own.
  const model::Model stopped =
      with_effect(bare, "hard_stop", "thigh", {3e5, 1.0, 0.0, wall, 1.0, 1.0, 0.0, 0.0, 1.0});
  const run::CommandedRun run = simulate(stopped, experiment, quiet());
  const model::Plant plant(stopped, {});
  int crossings = 0;
  for (Eigen::Index k = 1; k < run.time.size(); ++k) {
    const bool before = plant.position_of("thigh", run.states.col(k - 1).data()) > wall;
    const bool after = plant.position_of("thigh", run.states.col(k).data()) > wall;
    crossings += before != after ? 1 : 0;
  }
  ASSERT_GE(crossings, 2) << "the leg never met the stop";
  int met = 0;
  for (const integrate::Event& event : run.events) {
    if (event.index != 0) {
      continue;  // the penetration is the law's first switching function
    }
    ++met;
    EXPECT_NEAR(position_at(stopped, run, "thigh", event.time), wall, 1e-8) << "at " << event.time << " s";
    EXPECT_NE(event.direction, 0);
  }
  std::printf("%d crossings, %d events\n", crossings, met);
  EXPECT_EQ(met, crossings);
}

}  // namespace
}  // namespace plumbline::limits
