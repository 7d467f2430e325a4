// The diagnosis on twins of MABEL's leg on the bench: nothing hidden, one effect hidden, and that effect
// taken out of the catalogue.
#include "validation/diagnose/diagnose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/model/robot_file.h"
#include "validation/twin/twin.h"

namespace plumbline::validation {
namespace {

const char* const kRobot = "robots/mabel/";

Data twins(const model::Model& bare, const effects::Catalogue& catalogue, const std::string& hidden) {
  model::Model robot = bare;
  if (!hidden.empty()) {
    robot.effects.push_back(parse_effect(hidden, bare, catalogue));
  }
  std::vector<Trial> trials;
  for (const char* name : {"siso_mLA", "siso_mLS", "mimo"}) {
    const Experiment experiment =
        read_experiment(std::string(kRobot) + "experiments/" + name + ".yaml", bare);
    trials.push_back(twin(robot, experiment, {}));
    trials.back().name = trials.back().file = name;
  }
  return Data(std::move(trials), {});
}

Diagnosis diagnosed(const std::string& hidden, const std::vector<std::string>& without) {
  const effects::Catalogue all = effects::Catalogue::all();
  const model::Model bare = model::read_model(std::string(kRobot) + "leg_bench.yaml", all);
  const Data data = twins(bare, all, hidden);
  effects::Catalogue catalogue = all;
  for (const std::string& name : without) {
    catalogue = catalogue.without(name);
  }
  return diagnose(bare, catalogue, data, {}, [](const std::string& /*what*/, double /*fraction*/) {});
}

TEST(Diagnose, SaysNothingIsMissingOnTheModelsOwnData) {
  const Diagnosis d = diagnosed("", {});
  EXPECT_EQ(d.verdict, Verdict::nothing_missing);
  EXPECT_TRUE(d.accepted.empty());
  EXPECT_NEAR(d.ladder.back().held_out(), 1.0, 0.05);
}

TEST(Diagnose, NamesAHiddenActuatorLagAndItsValue) {
  const Diagnosis d = diagnosed("actuator_lag@mLS:time_constant=0.002", {});
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.verdict, Verdict::missing);
  EXPECT_EQ(d.accepted[0].effect, "actuator_lag");
  EXPECT_EQ(d.accepted[0].at, "mLS");
  EXPECT_NEAR(d.accepted[0].parameters[0].value, 0.002, 2e-5);
  EXPECT_LT(d.accepted[0].held_out_after, 1.05);
  EXPECT_GT(d.accepted[0].held_out_before, 1.3);
}

}  // namespace
}  // namespace plumbline::validation
