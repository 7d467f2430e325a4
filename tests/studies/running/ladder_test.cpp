// Thumper's controller in the simulator: sampled, with counts, on ground that gives.
#include "validation/studies/running/ladder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "simulator/trace/error.h"

namespace plumbline::running_tests {
namespace {

using namespace validation;

const std::string kRobot = PLUMBLINE_ROOT "/robots/thumper/";

RunningLadder ladder(const std::string& rungs) {
  const std::string path = testing::TempDir() + "ladder.yaml";
  std::ofstream(path) << "plumbline: running_ladder/1\ntitle: test\nscenario: " << kRobot
                      << "scenarios/running.yaml\ncycles: 10\n"
                      << "push: {of: hip_x, value: 0.05, unit: m/s, assumed: test}\nrungs:\n"
                      << rungs;
  return read_running_ladder(path);
}

TEST(RunningLadder, RunsSampledWithCountsAndWithout) {
  const auto results = climb(ladder("  - {name: counts}\n  - {name: exact, counts: false}\n"), nullptr,
                             [](const RungResult&) {});
  ASSERT_EQ(results.size(), 2u);
  for (const RungResult& result : results) {
    EXPECT_FALSE(result.fell) << result.name << ": " << result.end;
    EXPECT_GE(result.steps, 10) << result.name;
    EXPECT_GT(result.speed, 1.0) << result.name;
  }
}

// What the controller needs is taken from it: it falls, so that running is no accident of the ground.
TEST(RunningLadder, FallsWithoutTheTorque) {
  const auto results =
      climb(ladder("  - {name: weak, set: {leg_shape_torque: 2}}\n"), nullptr, [](const RungResult&) {});
  EXPECT_TRUE(results.front().fell);
  EXPECT_LT(results.front().steps, 10);
}

TEST(RunningLadder, RefusesInOneLine) {
  try {
    ladder("  - {name: x, modle: y}\n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean model"), std::string::npos) << error.what();
  }
  EXPECT_THROW(climb(ladder("  - {name: x, set: {no_such: 1}}\n"), nullptr, [](const RungResult&) {}),
               InputError);
}

}  // namespace
}  // namespace plumbline::running_tests
