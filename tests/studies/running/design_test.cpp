// The design of Thumper's gait from its file, whole.
#include "validation/studies/running/design.h"

#include <gtest/gtest.h>

#include "validation/studies/running/running_file.h"

namespace plumbline::running_tests {
namespace {

using namespace validation;

TEST(RunningDesign, FindsTheMotionThatTheControllersFileHolds) {
  RunningDesignFile file = read_running_design(PLUMBLINE_ROOT "/robots/thumper/running_design.yaml");
  const DesignedRunning done = design_running(file.design);
  EXPECT_EQ(done.status, "solved");
  EXPECT_LT(done.gap, 1e-6);
  EXPECT_LT(done.period_error, 1e-9);
  EXPECT_LT(done.facts.most_friction, 0.6);
  EXPECT_GT(done.facts.least_normal, 0.0);
  EXPECT_TRUE(done.facts.spring_at_rest);
  const monopod::Parameters kept = read_running(PLUMBLINE_ROOT "/robots/thumper/controllers/running.yaml");
  // The minimum is flat where nothing tells: a thousandth of the rates is far within what it is known to.
  EXPECT_LT((done.gait.section - kept.gait.section).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_NEAR(done.constants.torso.mass, kept.model.torso.mass, 1e-2);
}

}  // namespace
}  // namespace plumbline::running_tests
