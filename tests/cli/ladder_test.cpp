// The ladder climbs a model's lineage and says what each rung left.
#include <gmock/gmock.h>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

class Ladder : public RobotFolder {
 protected:
  void SetUp() override {
    RobotFolder::SetUp();
    write("robot/overlay.yaml",
          "plumbline: model/1\nbase: model.yaml\nnote: \"coulomb added\"\neffects:\n"
          "  - {effect: coulomb, at: drive, values: {level: {value: 0.008, unit: N m, source: test}, "
          "smoothing_speed: {value: 0.5, unit: rad/s, source: test}}}\n");
  }
};

TEST_F(Ladder, BaseFirstAndTheErrorFalls) {
  const Outcome outcome = succeed(
      {"ladder", "trials/chirp", "trials/swing", "--model", "robot/overlay.yaml", "--json", "ladder.json"});
  EXPECT_THAT(outcome.out, HasSubstr("(2) overlay.yaml + coulomb@drive"));
  EXPECT_THAT(outcome.out, HasSubstr("[2] swing (held-out)"));
  EXPECT_THAT(outcome.out, HasSubstr("[2] inverse"));
  EXPECT_THAT(outcome.out, HasSubstr("no closed loop, no controller is known"));
  const nlohmann::json json = read_json("ladder.json");
  EXPECT_THAT(keys(json), UnorderedElementsAre("models", "published"));
  ASSERT_EQ(json["models"].size(), 2U);
  const nlohmann::json& bare = json["models"][0];
  const nlohmann::json& full = json["models"][1];
  EXPECT_THAT(keys(bare),
              UnorderedElementsAre("file", "name", "train", "held_out", "test", "windows", "trials"));
  EXPECT_EQ(bare["windows"]["held_out"], bare["held_out"]);
  EXPECT_THAT(outcome.out, HasSubstr("Each phase of the motion"));
  EXPECT_THAT(outcome.out, HasSubstr("Each channel (root mean square of measured less predicted"));
  EXPECT_EQ(bare["name"], "model.yaml");
  EXPECT_LT(full["train"], 0.5 * bare["train"].get<double>());
  EXPECT_LT(full["held_out"], 0.5 * bare["held_out"].get<double>());
  const nlohmann::json& swing = full["trials"][1];
  EXPECT_THAT(keys(swing), UnorderedElementsAre("trial", "data", "role", "closed_loop", "inverse_model"));
  EXPECT_EQ(swing["role"], "held-out");
  EXPECT_LT(swing["inverse_model"]["motors"][0]["force_percent"],
            bare["trials"][1]["inverse_model"]["motors"][0]["force_percent"].get<double>());
}

TEST_F(Ladder, PublishedValuesStandBeside) {
  write("robot/reference.yaml",
        "plumbline: reference/1\nvalues:\n  - {compares: inverse_force, model: theirs, data: data.csv, "
        "value: 7.5, "
        "unit: \"%\", source: page 3}\n");
  const Outcome outcome = succeed({"ladder", "trials/chirp", "--json", "ladder.json"});
  EXPECT_THAT(outcome.out, HasSubstr("published: theirs"));
  EXPECT_THAT(outcome.out, HasSubstr("7.5"));
  EXPECT_EQ(read_json("ladder.json")["published"][0]["compares"], "inverse_force");
  EXPECT_TRUE(read_json("ladder.json")["models"][0]["held_out"].is_null());
}

TEST_F(Ladder, WrongCommandUnitIsRefused) {
  replace("robot/model.yaml", "torque_constant: {value: 0.0525", "torque_constant: {value: 52.5");
  for (const char* command : {"ladder", "compare", "diagnose"}) {
    const Outcome outcome = plumbline({command, "trials/chirp"});
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_THAT(outcome.err, HasSubstr("commands.drive.column")) << command;
    EXPECT_THAT(outcome.err, HasSubstr("times the force of column \"u_drive\" in A")) << command;
  }
}

}  // namespace
}  // namespace plumbline::test
