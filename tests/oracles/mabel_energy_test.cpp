// MABEL in the air with its springs deflecting, hitting their stops and its cables stretching: the account of
// energy closes.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "simulator/run/commanded_run.h"
#include "tests/oracles/mabel_in_the_air.h"

namespace plumbline::oracles {
namespace {

constexpr double kPeriod = 1e-3;
constexpr Eigen::Index kSamples = 300;

run::CommandedRun swing(const std::string& file) {
  const model::Model model = mabel_in_the_air(file);
  model::Plant plant(model, {});
  Eigen::MatrixXd commands(4, kSamples);
  for (Eigen::Index k = 0; k < kSamples; ++k) {
    const double t = kPeriod * static_cast<double>(k);
    commands.col(k) << 2.0 * std::sin(20.0 * t), 6.0 * std::sin(30.0 * t), -3.0 * std::sin(15.0 * t),
        8.0 * std::sin(25.0 * t);
  }
  run::CommandedOptions options;
  options.integrator.method = integrate::Method::bdf;
  options.integrator.relative_tolerance = 1e-7;
  return run::run_commands(plant, Eigen::VectorXd::Zero(plant.states()), commands, kPeriod, 0.0, {}, nullptr,
                           options);
}

TEST(MabelEnergy, AccountCloses) {
  for (const char* file : {"mabel_planar.yaml", "mabel.yaml"}) {
    const auto start = std::chrono::steady_clock::now();
    const run::CommandedRun result = swing(file);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    std::printf("%s: %.2g of %.3g J missing, %ld switches, %ld rates, %.3f s for %.1f s\n", file,
                result.energy_error, result.energy_exchanged, result.summary.switches_found,
                result.summary.rate_evaluations, spent.count(), kPeriod * static_cast<double>(kSamples));
    EXPECT_GT(result.energy_exchanged, 10.0);
    EXPECT_GE(result.summary.switches_found, 2) << "the springs should meet their stops";
    EXPECT_LT(std::abs(result.energy_error) / result.energy_exchanged, 1e-5);
  }
}

}  // namespace
}  // namespace plumbline::oracles
