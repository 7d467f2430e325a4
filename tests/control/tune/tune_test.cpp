// The search for constants of a controller: its cost, its file, and that what was found is kept.
#include "validation/control/tune/tune.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "simulator/trace/error.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::validation {
namespace {

// Worked out by hand: half the cycles missing costs 10; of the two settled ones (ten, less five and three)
// one is off by two tolerances, one by four: log(1 + (4 + 16)/2).
TEST(GaitCost, IsWhatItsDescriptionSays) {
  PublishedQuantity travel;
  travel.quantity.value = -0.27;
  travel.tolerance.value = 0.03;
  GaitRun run;
  run.run.fell = true;
  for (int c = 0; c < 10; ++c) {
    Cycle cycle;
    cycle.values = {c == 6 ? -0.39 : -0.33};
    run.cycles.push_back(cycle);
  }
  const Gait gait;
  EXPECT_NEAR(gait_cost(gait, {run}, 20, {travel}), 10.0 + std::log(11.0), 1e-12);
  EXPECT_NEAR(gait_cost(gait, {GaitRun()}, 20, {travel}), 20.0 + std::log(901.0), 1e-12);
}

TEST(TuneFile, TheShippedOnesFitTheirController) {
  for (const char* name : {"hopping.yaml", "hopping_sides.yaml"}) {
    TuneFile file = read_tune(std::string(PLUMBLINE_ROOT "/robots/mabel/tune/") + name);
    const PublishedRobot robot = read_published(file.published, {file.gait, {}, ""});
    check_searched(file, *robot.gaits.front().loaded.controller);
    EXPECT_EQ(file.searched.back().lower, 2.0);
    EXPECT_EQ(file.searched.back().upper, 12.0);
    file.searched.front().constants = {"no_such"};
    EXPECT_THROW(check_searched(file, *robot.gaits.front().loaded.controller), InputError);
    file.searched.front().constants = {"delta_phi_d"};  // below zero
    EXPECT_THROW(check_searched(file, *robot.gaits.front().loaded.controller), InputError);
  }
}

// What was found until then is not lost.
TEST(Tune, ReturnsTheBestSoFarWhenItIsInterrupted) {
  TuneFile file = read_tune(PLUMBLINE_ROOT "/robots/mabel/tune/hopping.yaml");
  const PublishedRobot robot = read_published(file.published, {file.gait, {}, ""});
  const PublishedGait& gait = robot.gaits.front();
  check_searched(file, *gait.loaded.controller);
  StopFlag stop;
  TuneOptions options;
  options.trials = 100000;
  options.starts = 1;
  options.enough = 2;
  options.run.integrator.set_tolerance(1e-4);
  options.stop = &stop;
  double cheapest = std::numeric_limits<double>::infinity();
  const TuneResult best = tune(gait, file.searched, options, [&](int set, const TuneResult& result) {
    cheapest = std::min(cheapest, result.cost);
    const double samples = result.constants[gait.loaded.controller->constant_index("leg_angle_samples")];
    EXPECT_EQ(samples, std::round(samples));
    stop.raised = set > 2;
  });
  EXPECT_TRUE(best.interrupted);
  EXPECT_EQ(best.cost, cheapest);
  EXPECT_THROW(tune(gait, file.searched, options, [](int, const TuneResult&) {}), Stopped);
}

}  // namespace
}  // namespace plumbline::validation
