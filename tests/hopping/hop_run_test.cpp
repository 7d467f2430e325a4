// MABEL in the plane hopping: its start, its hops, its fall.
#include "validation/hopping/hop_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/hopping/hopping_file.h"

namespace plumbline::validation {
namespace {

model::Model mabel(const std::string& name) {
  return model::read_model(PLUMBLINE_ROOT "/robots/mabel/" + name, model::known_effects());
}

controllers::HoppingConfig controller() { return read_hopping(PLUMBLINE_ROOT "/robots/mabel/hopping.yaml"); }

class HopFrom : public testing::TestWithParam<const char*> {};

TEST_P(HopFrom, TheStartIsTheFlightPhasesPose) {
  model::Plant plant(mabel(GetParam()), {});
  const controllers::HoppingConfig config = controller();
  HopStart start;
  start.drop = 0.04;
  start.torso = 0.01;
  start.speed = -0.5;
  const Eigen::VectorXd x = start_state(plant, config, start);
  EXPECT_NEAR(plant.position_of("torso", x.data()), 0.15, 1e-9);
  EXPECT_NEAR(plant.position_of("leg_angle_left", x.data()), -0.262 - 0.14, 1e-9);
  EXPECT_NEAR(plant.position_of("leg_angle_right", x.data()), 0.262 - 0.14, 1e-9);
  EXPECT_NEAR(plant.position_of("leg_shape_right", x.data()), 0.209, 1e-9);
  EXPECT_NEAR(plant.position_of("mLS_right", x.data()), 31.42 * 0.209, 1e-8);  // no cable is stretched
  const std::vector<model::Touch> touches = plant.touches(x.data());
  EXPECT_NEAR(std::max(touches[0].depth, touches[1].depth), -0.04, 1e-8);
  EXPECT_NEAR(touches[0].velocity.x(), -0.5, 0.05);  // the boom's inner leg is slower
}

TEST_P(HopFrom, ItHopsAndLandsAndCanBeRepeated) {
  const model::Model model = mabel(GetParam());
  HopOptions options;
  options.hops = 3;
  options.trace = true;
  const HopRun run = hop(model, controller(), {}, options);
  ASSERT_EQ(run.hops.size(), 3U) << run.end;
  EXPECT_FALSE(run.fell);
  for (const Hop& hop : run.hops) {
    EXPECT_GT(hop.period, 0.2);
    EXPECT_LT(hop.period, 2.0);
    EXPECT_GT(hop.highest_hip - hop.lowest_hip, 0.02);
    EXPECT_GT(hop.largest_stretch_LS, 0.5);  // the cables give way
  }
  const HopRun again = hop(model, controller(), {}, options);
  EXPECT_EQ(run.hops.back().landing, again.hops.back().landing);
  EXPECT_EQ(run.trace.columns.back().values, again.trace.columns.back().values);
}

INSTANTIATE_TEST_SUITE_P(Mabel, HopFrom, testing::Values("mabel_planar.yaml", "mabel.yaml"),
                         [](const auto& tested) {
                           return std::string(tested.param) == "mabel.yaml" ? "boom" : "plane";
                         });

TEST(HopRunTest, WithoutTorqueItFallsAndSaysHowAndWhen) {
  controllers::HoppingConfig config = controller();
  config.torque_limit_mLA = 1e-6;
  config.torque_limit_mLS = 1e-6;
  config.workspace = {};
  const HopRun run = hop(mabel("mabel_planar.yaml"), config, {}, HopOptions());
  EXPECT_TRUE(run.fell);
  EXPECT_THAT(run.end,
              testing::ContainsRegex("fell .*at [0-9.]+ s: the (hip is down|torso has turned over)"));
  EXPECT_GT(run.time_at_limit, 2.0 * run.time);  // most motors, most of the time
}

TEST(HopRunTest, TimeAtTheTorquesLimitIsCounted) {
  HopOptions options;
  options.hops = 1;
  options.longest = 0.4;
  controllers::HoppingConfig config = controller();
  config.torque_limit_mLA = config.torque_limit_mLS = 1e6;
  EXPECT_EQ(hop(mabel("mabel_planar.yaml"), config, {}, options).time_at_limit, 0.0);
}

TEST(HopRunTest, AHardStopsSwitchTurnsThePowerOffForGood) {
  controllers::HoppingConfig config = controller();
  config.workspace.leg_shape_to = config.parameters.h_LS_left + 0.02;  // passed when it lands
  HopOptions options;
  options.trace = true;
  const HopRun run = hop(mabel("mabel_planar.yaml"), config, {}, options);
  EXPECT_TRUE(run.fell);
  EXPECT_THAT(run.end,
              testing::ContainsRegex("hard stop's switch closed at [0-9.]+ s .leg shape, .*power off; "));
  const double off = std::stod(run.end.substr(run.end.find(" at ") + 4));
  const Column* time = nullptr;
  for (const Column& column : run.trace.columns) {
    time = column.name == "t" ? &column : time;
    if (column.name.rfind("u_", 0) != 0) {
      continue;
    }
    for (Eigen::Index k = 0; k < column.values.size(); ++k) {
      if (time->values[k] > off - 1e-9) {
        ASSERT_EQ(column.values[k], 0.0) << column.name << " at " << time->values[k];
      }
    }
  }
}

TEST(HopRunTest, AGaitThatNeverLeavesTheGroundEnds) {
  controllers::HoppingConfig config = controller();
  config.parameters.delta_LS_minus_left = config.parameters.delta_LS_minus_right = 0.0;  // no kickoff
  config.parameters.delta_LS_plus_left = config.parameters.delta_LS_plus_right = 0.0;
  config.left.kp_LA = config.right.kp_LA = 1500.0;  // stands
  config.left.kd_LA = config.right.kd_LA = 80.0;
  config.left.kp_mLS = config.right.kp_mLS = 10.0;
  config.left.kd_mLS = config.right.kd_mLS = 0.3;
  config.parameters.h_T0 = 0.0;
  HopStart start;
  start.drop = 0.002;
  start.speed = 0.0;
  const HopRun run = hop(mabel("mabel_planar.yaml"), config, start, HopOptions());
  EXPECT_TRUE(run.fell);
  EXPECT_THAT(run.end, testing::AnyOf(testing::ContainsRegex("leaves? the ground, on it since [0-9.]+ s"),
                                      testing::HasSubstr("stays in phase")));
  EXPECT_LT(run.time, 10.0);
}

TEST(HopRunTest, APlatformInsideAFootAtTheStartIsRefused) {
  HopOptions options;
  options.hops = 1;
  options.terrain = contact::Terrain(0.0, {{0.1, 0.5, 0.15}});  // under the right foot, which is in front
  try {
    hop(mabel("mabel_planar.yaml"), controller(), {}, options);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("right foot"), testing::HasSubstr("inside")));
  }
  options.terrain = contact::Terrain(0.0, {{5.0, 6.0, 0.15}});
  EXPECT_NO_THROW(hop(mabel("mabel_planar.yaml"), controller(), {}, options));
}

TEST(HopRunTest, AnIntegratorThatGivesUpIsQuotedAndTheTraceKept) {
  HopOptions options;
  options.trace = true;
  options.integrator.max_steps = 40;  // enough in the air, too few at touchdown
  options.integrator.relative_tolerance = 1e-7;
  const HopRun run = hop(mabel("mabel_planar.yaml"), controller(), {}, options);
  EXPECT_TRUE(run.fell);
  EXPECT_THAT(run.end, testing::HasSubstr("rosenbrock failed after t = "));
  EXPECT_THAT(run.end, testing::ContainsRegex("Largest local error: (position|velocity|bristle)"));
  EXPECT_THAT(run.end, testing::ContainsRegex("Stiffest: [a-z_]+ at [a-z_]+ .alone it is as fast as"));
  EXPECT_GT(run.time, 0.0);
  EXPECT_EQ(run.trace.rows(), std::lround(run.time / 1e-3) + 1);  // each sample until then
}

TEST(HopRunTest, AModelWithoutFeetIsRefused) {
  model::Model model = mabel("mabel_planar.yaml");
  model.feet.clear();
  EXPECT_THROW(hop(model, controller(), {}, HopOptions()), InputError);
}

}  // namespace
}  // namespace plumbline::validation
