// Contact intensities against the impact map itself, and runs over ground that falls.
#include "validation/studies/step_down/step_down.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/start.h"
#include "simulator/trace/error.h"
#include "tests/trace/temporary_folder.h"
#include "validation/studies/step_down/contact_intensity.h"

namespace plumbline::validation {
namespace {

using testing::HasSubstr;

const std::string kMabel = PLUMBLINE_ROOT "/robots/mabel/";

/// MABEL just before a touchdown, all joints' rates times `factor`.
Eigen::VectorXd before_touchdown(model::Plant& plant, double factor) {
  run::Start start;
  start.positions = {{"torso", -0.14},         {"leg_angle_left", -0.15}, {"leg_angle_right", 0.43},
                     {"leg_shape_left", 0.09}, {"leg_shape_right", 0.09}, {"bsp_left", 0.06},
                     {"bsp_right", 0.0}};
  start.velocities = {{"hip_x", 0.9 * factor},
                      {"hip_z", -0.2 * factor},
                      {"torso", 0.1 * factor},
                      {"leg_angle_left", -1.0 * factor},
                      {"leg_shape_right", 0.3 * factor}};
  return run::start_state(plant, start);
}

// On the whole machine, cables and all, the intensity is that of the design model in the same pose: what its
// own impact map says. Impulses are linear in the velocities.
TEST(ContactIntensity, IsTheImpactMapOfTheDesignModel) {
  const RigidGait design = read_rigid_gait(kMabel + "walking_design.yaml");
  ContactIntensity intensity(design);
  model::Plant own(design.model, {});
  const Eigen::VectorXd x = before_touchdown(own, 1.0);
  model::RigidContact contact(own);
  Eigen::VectorXd after = x;
  const int right = contact.kinematics().index_of("right");
  const Eigen::Vector3d expected = contact.strike({{right}, {"bsp_left"}}, after.data()).feet.front();
  EXPECT_GT(expected.z(), 1.0);
  EXPECT_LT((intensity.of(own, x, "right") - expected).norm(), 1e-9);

  model::Plant whole(model::read_model(kMabel + "mabel_planar.yaml", model::known_effects()), {});
  const Eigen::VectorXd there = before_touchdown(whole, 1.0);
  EXPECT_LT((intensity.of(whole, there, "right") - expected).norm(), 1e-6);
  EXPECT_LT((intensity.of(whole, before_touchdown(whole, 2.0), "right") - 2.0 * expected).norm(), 1e-6);
  EXPECT_THROW(intensity.of(whole, there, "middle"), InputError);
}

TEST(StepDownFile, TheShippedOneIsWhole) {
  const StepDownTest test = read_step_down(kMabel + "step_down.yaml");
  EXPECT_EQ(test.heights.size(), 8U);
  EXPECT_NEAR(test.heights.back(), 0.0889, 1e-12);
  EXPECT_EQ(test.controllers.size(), 3U);
  ASSERT_EQ(test.published.size(), 5U);
  EXPECT_FALSE(test.published.back().passed);
  EXPECT_EQ(test.published.back().second, 46.5);
}

TEST(StepDownFile, BadOnesAreRefused) {
  const test::TemporaryFolder folder;
  const std::string head = "plumbline: step_down/1\ntitle: x\nimpact: " + kMabel + "walking_design.yaml\n";
  const auto refusal = [&](const std::string& text) -> std::string {
    try {
      read_step_down(folder.write("step_down.yaml", head + text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("scenario: " + kMabel + "scenarios/hopping.yaml\n"),
              HasSubstr("whose gait has no steps"));
  EXPECT_THAT(refusal("scenario: " + kMabel + "scenarios/walking.yaml\nedg: 1\n"),
              HasSubstr("did you mean edge"));
}

// The ground falls by 1 inch under the third step: the touchdowns below are told from those above, the second
// comes behind the first, and a fuse that is weaker than a common step breaks at once.
TEST(StepDown, TellsTheLowerGroundAndTheFuse) {
  StepDownTest test = read_step_down(kMabel + "step_down.yaml");
  test.edge = 1.2;
  test.enough = 2;
  test.fuse = 1e3;
  const StepDownRun run = step_down(test, test.scenario, 0.0254, nullptr);
  EXPECT_EQ(run.outcome, StepDownRun::Outcome::passed) << run.end;
  ASSERT_NE(run.behind_edge(2), nullptr);
  EXPECT_EQ(run.behind_edge(3), nullptr);
  EXPECT_GT(run.behind_edge(2)->time, run.behind_edge(1)->time + 0.2);
  EXPECT_FALSE(run.touchdowns.front().lower);
  EXPECT_GT(run.behind_edge(1)->force_impulse, 0.0);
  test.fuse = 0.5;
  const StepDownRun broken = step_down(test, test.scenario, 0.0254, nullptr);
  EXPECT_EQ(broken.outcome, StepDownRun::Outcome::broke);
  EXPECT_THAT(broken.end, HasSubstr("the fuse in the"));
}

}  // namespace
}  // namespace plumbline::validation
