// What one step of the running controller costs beside its period.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "controllers/host/loaded_controller.h"
#include "validation/control/gait/gait_run.h"

namespace plumbline::validation {
namespace {

TEST(AtriasStep, TakesAFiftiethOfItsPeriod) {
  const run::LoadedScenario loaded =
      run::read_scenario(PLUMBLINE_ROOT "/robots/atrias/scenarios/running.yaml");
  const run::ControllerSetup& setup = *loaded.controller;
  const std::vector<double> scales(setup.library.inputs().size(), 1e-5);
  controllers::ControllerInstance instance(setup.library, setup.period, setup.constants, scales);
  std::vector<double> in(scales.size(), 0.0), out(setup.library.outputs().size()),
      log(setup.library.log().size());
  constexpr int steps = 20000;
  double best = 1.0, stood = 0.0;
  for (int round = 0; round < 5; ++round) {
    const std::clock_t begin = std::clock();
    for (int n = 0; n < steps; ++n) {
      // The links sway, the springs are loaded for a part of the time: both phases are gone through.
      const double sway = 4e4 + 1e3 * std::sin(0.02 * n), load = n % 400 < 200 ? -8e3 : 0.0;
      for (const std::size_t leg : {0U, 4U}) {
        in[leg] = 50.0 * (sway + load);
        in[leg + 1] = sway;
        in[leg + 2] = -50.0 * (sway + load);
        in[leg + 3] = -sway;
      }
      instance.step(in.data(), out.data(), log.data());
      stood += log[0];
    }
    best = std::fmin(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / steps);
  }
  EXPECT_GT(stood, steps) << "most of the time in one of two phases only";
  EXPECT_LT(stood, 4.0 * steps);
  EXPECT_LT(best / setup.period, 0.02)
      << "the least of five rounds: other programs may use the processor, too";
  std::printf("one step: %.2f us, %.0f %% of them in stance\n", 1e6 * best, stood / steps * 20.0);
}

}  // namespace
}  // namespace plumbline::validation
