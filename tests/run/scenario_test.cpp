// Scenarios: where a run starts, what its controller sees, and when it is over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/run/run_scenario.h"
#include "simulator/trace/table.h"
#include "tests/run/files.h"

namespace plumbline::run {
namespace {

using testing::HasSubstr;

const Eigen::VectorXd& column(const Table& table, const std::string& name) {
  const Column* found = table.find(name);
  EXPECT_NE(found, nullptr) << name;
  return found->values;
}

class Hopping : public testing::TestWithParam<const char*> {};

TEST_P(Hopping, TheStartIsTheFlightPhasesPose) {
  LoadedScenario loaded = read_scenario(robots(std::string("mabel/scenarios/") + GetParam()));
  loaded.scenario.start.clearance = 0.04;
  model::Plant plant(loaded.model, {});
  const Eigen::VectorXd x = start_state(plant, loaded.scenario.start);
  EXPECT_NEAR(plant.position_of("torso", x.data()), 0.14, 1e-9);
  EXPECT_NEAR(plant.position_of("leg_angle_left", x.data()), -0.262 - 0.14, 1e-9);
  EXPECT_NEAR(plant.position_of("leg_shape_right", x.data()), 0.209, 1e-9);
  EXPECT_NEAR(plant.position_of("mLS_right", x.data()), 31.42 * 0.209, 1e-8);  // no cable is stretched
  const std::vector<model::Touch> touches = plant.touches(x.data());
  EXPECT_NEAR(std::max(touches[0].depth, touches[1].depth), -0.04, 1e-8);
  EXPECT_NEAR(touches[0].velocity.x(), -0.3, 0.05);  // the boom's inner leg is slower
}

TEST_P(Hopping, ItLandsAndCanBeRepeated) {
  LoadedScenario loaded = read_scenario(robots(std::string("mabel/scenarios/") + GetParam()));
  loaded.scenario.longest = 0.6;
  RunOptions options;
  options.trace = true;
  const RunRecord run = run_scenario(loaded.model, loaded.scenario, &*loaded.controller, options);
  EXPECT_FALSE(run.fell) << run.end;
  EXPECT_GE(column(run.trace, "phase").maxCoeff(), 2.0);  // it has come down
  const RunRecord again = run_scenario(loaded.model, loaded.scenario, &*loaded.controller, options);
  EXPECT_EQ(column(run.trace, "q_torso"), column(again.trace, "q_torso"));
}

INSTANTIATE_TEST_SUITE_P(Files, Hopping, testing::Values("hopping.yaml", "hopping_boom.yaml"));

// Samples of the trace that `plumbline hop` wrote before controllers were libraries (hopping_reference.csv);
// on the machine that wrote it all columns of six hops are the same to the last bit. Another libm may round
// otherwise.
TEST(Scenario, HoppingIsAsItWasBeforeControllersWereLibraries) {
  LoadedScenario loaded = read_scenario(robots("mabel/scenarios/hopping.yaml"));
  loaded.scenario.longest = 1.0;
  RunOptions options;
  options.trace = true;
  const RunRecord run = run_scenario(loaded.model, loaded.scenario, &*loaded.controller, options);
  const Table reference = read_table(PLUMBLINE_ROOT "/tests/run/hopping_reference.csv");
  ASSERT_EQ(reference.rows(), 41);
  for (const Column& wanted : reference.columns) {
    const Eigen::VectorXd& found = column(run.trace, wanted.name);
    for (Eigen::Index k = 0; k < reference.rows(); ++k) {
      EXPECT_NEAR(found[25 * k], wanted.values[k], 1e-6 * std::max(1.0, std::abs(wanted.values[k])))
          << wanted.name << " at " << reference.columns[0].values[k] << " s";
    }
  }
}

/// The example in C on the leg's bench: controller and record see the same counts.
TEST(Scenario, TheControllerSeesWhatIsRecorded) {
  const LoadedScenario loaded = read_scenario(robots("mabel/scenarios/hold_leg_angle.yaml"));
  RunOptions options;
  options.trace = true;
  options.energy = true;
  const RunRecord run = run_scenario(loaded.model, loaded.scenario, &*loaded.controller, options);
  EXPECT_NEAR(run.time, 1.0, 1e-9);
  const Eigen::VectorXd& recorded = column(run.record, "q_mLA");
  const Eigen::VectorXd& error = column(run.trace, "error");
  const double wanted = loaded.controller->constant("position_wanted");
  for (Eigen::Index k = 0; k < recorded.size(); ++k) {
    ASSERT_EQ(error[k], wanted - recorded[k]) << k;
  }
  EXPECT_NEAR(recorded[recorded.size() - 1], wanted,
              0.2);  // held against the leg's weight by a spring in software
  EXPECT_GT((recorded - column(run.trace, "q_mLA")).cwiseAbs().maxCoeff(), 0.0);  // counts are not the truth
  EXPECT_LT(std::abs(run.energy_error), 1e-3 * run.energy_exchanged);
}

TEST(Scenario, AnEndIsSaidInWords) {
  LoadedScenario loaded = read_scenario(robots("mabel/scenarios/hopping.yaml"));
  for (const char* name : {"kp_LA_left", "kp_LA_right", "kp_mLS_left", "kp_mLS_right"}) {
    loaded.controller->set(name, 0.0);
  }
  const RunRecord run = run_scenario(loaded.model, loaded.scenario, &*loaded.controller, {});
  EXPECT_TRUE(run.fell);
  EXPECT_THAT(run.end,
              testing::AnyOf(HasSubstr("fell"), HasSubstr("ground"), HasSubstr("switch of a hard stop")));
  EXPECT_LT(run.time, 10.0);
}

// Without a controller the robot sinks onto both feet; neither motor is commanded.
TEST(Scenario, AFallSaysWhereTheFeetAre) {
  const LoadedScenario loaded = read_scenario(robots("mabel/scenarios/walking.yaml"));
  const RunRecord run = run_scenario(loaded.model, loaded.scenario, nullptr, {});
  ASSERT_TRUE(run.fell);
  EXPECT_THAT(run.end, HasSubstr("foot left "));
  EXPECT_THAT(run.end, HasSubstr("foot right "));
  EXPECT_THAT(run.end, HasSubstr(" since "));
  EXPECT_THAT(run.end, testing::Not(HasSubstr("largest torque")));
}

TEST(Scenario, APlatformUnderAFootIsRefused) {
  LoadedScenario loaded = read_scenario(robots("mabel/scenarios/hopping.yaml"));
  loaded.scenario.terrain = contact::Terrain(0.0, {{-1.0, 1.0, 0.3}});
  EXPECT_THAT(
      message_of<InputError>([&] { run_scenario(loaded.model, loaded.scenario, &*loaded.controller, {}); }),
      HasSubstr("inside the terrain at the start"));
}

TEST(Scenario, StartsAreDrawnWithinTheirRangesAndAgainWithTheSeed) {
  const LoadedScenario loaded = read_scenario(robots("mabel/scenarios/hopping_boom.yaml"));
  std::vector<Start> starts = draw_starts(loaded.scenario, 50, 3);
  std::vector<Start> again = draw_starts(loaded.scenario, 50, 3);
  for (std::size_t k = 0; k < starts.size(); ++k) {
    EXPECT_GE(starts[k].clearance, 0.03);
    EXPECT_LE(starts[k].clearance, 0.07);
    EXPECT_GE(*starts[k].velocity("tower"), -0.6 / 2.25);
    EXPECT_LE(*starts[k].velocity("tower"), -0.1 / 2.25);
    EXPECT_NEAR(*starts[k].position("torso"), 0.14, 0.02);
    EXPECT_EQ(*starts[k].position("torso"), *again[k].position("torso"));
  }
}

TEST(Scenario, EveryMistakeIsOneLine) {
  const auto error_of = [](const std::string& rest) {
    const Folder folder;
    const std::string file = folder.write(
        "s.yaml", "plumbline: scenario/1\ntitle: test\nmodel: " + robots("mabel/mabel_planar.yaml") +
                      "\nlength: {value: 1, unit: s}\n" + rest);
    return message_of<InputError>([&] { read_scenario(file); });
  };
  EXPECT_EQ(error_of(""), "");
  EXPECT_THAT(error_of("start: {positions: {hip_y: {value: 0, unit: m}}}\n"), HasSubstr("did you mean hip_"));
  EXPECT_THAT(error_of("start: {positions: {hip_x: {value: 0, unit: rad}}}\n"),
              HasSubstr("a unit like \"m\""));
  EXPECT_THAT(error_of("ends: [{of: hip_z}]\n"), HasSubstr("an end with one of above, below"));
  EXPECT_THAT(error_of("lenght: 3\n"), HasSubstr("did you mean length"));
  EXPECT_THAT(error_of("vary: [{what: height, from: {value: 0, unit: m}, to: {value: 1, unit: m}}]\n"),
              HasSubstr("position, velocity or clearance"));
}

}  // namespace
}  // namespace plumbline::run
