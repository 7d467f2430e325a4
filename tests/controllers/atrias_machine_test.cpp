// The running controller on the machine: the shared library, wired by its file, on robots/atrias.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "controllers/host/loaded_controller.h"
#include "validation/control/gait/gait_run.h"

namespace plumbline::validation {
namespace {

run::LoadedScenario read(const std::string& name) {
  return run::read_scenario(PLUMBLINE_ROOT "/robots/atrias/scenarios/" + name);
}

/// Speeds of the hip, true, over the steps, and how the run ended.
GaitRun run_steps(const run::LoadedScenario& loaded, long steps) {
  GaitView view;
  view.gait = *read_gait(loaded);
  Measure speed;
  speed.kind = Measure::Kind::at_end;
  speed.channels = {"v_hip_x"};
  Measure lean = speed;
  lean.channels = {"lean"};
  view.measures = {speed, lean};
  return run_gait(loaded, view, {steps, {}, nullptr});
}

TEST(AtriasMachine, RunsAtTheSpeedThatIsAskedFor) {
  const GaitRun done = run_steps(read("running.yaml"), 12);
  ASSERT_FALSE(done.run.fell) << done.run.end;
  ASSERT_EQ(done.cycles.size(), 12U);
  for (std::size_t n = 6; n < done.cycles.size(); ++n) {
    EXPECT_NEAR(done.cycles[n].values[0], 1.0, 0.05) << "Wu 2017, section 5.8.1; step " << n;
    EXPECT_LT(std::abs(done.cycles[n].values[1]), 7.6 * 3.1416 / 180.0);
  }
}

TEST(AtriasMachine, StepsUpAndDownAreRunOver) {
  for (const double height : {0.15, -0.15}) {
    run::LoadedScenario loaded = read("running.yaml");
    loaded.scenario.terrain = contact::Terrain(0.0, {{2.75, 100.0, height}});
    const GaitRun done = run_steps(loaded, 13);
    ASSERT_FALSE(done.run.fell) << height << " m: " << done.run.end;
    EXPECT_NEAR(done.cycles.back().values[0], 1.0, 0.1)
        << "Wu 2017, section 5.8.4: it comes back to its speed";
  }
}

TEST(AtriasMachine, ItsControllerIsWhatKeepsItUp) {
  run::LoadedScenario loaded = read("running.yaml");
  loaded.controller->set("stiffness", 8000.0);  // half the spring, half the force
  const GaitRun soft = run_steps(loaded, 12);
  EXPECT_TRUE(soft.run.fell || std::abs(soft.cycles.back().end - soft.cycles.back().begin - 0.455) > 0.05);
}

}  // namespace
}  // namespace plumbline::validation
