// `plumbline add` and what `plumbline fit` makes of it.
#include <gmock/gmock.h>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Add : public RobotFolder {
 protected:
  json effect_of(const std::string& model) const {
    succeed({"check", model, "--json", "model.json"});
    return read_json("model.json")["effects"].back();
  }
};

TEST_F(Add, StartsAtTheNullValuesAndChangesNothing) {
  succeed({"add", "coulomb", "--at", "drive", "--model", "robot/model.yaml", "--out", "new.yaml"});
  const json effect = effect_of("new.yaml");
  EXPECT_EQ(effect["effect"], "coulomb");
  EXPECT_EQ(effect["at"], "drive");
  EXPECT_EQ(effect["values"]["level"]["value"], 0.0);
  EXPECT_EQ(effect["values"]["level"]["assumed"], true);
  succeed({"compare", "trials/steps", "--json", "before.json"});
  succeed({"compare", "trials/steps", "--model", "new.yaml", "--json", "after.json"});
  EXPECT_NEAR(
      read_json("before.json")["train"].get<double>() / read_json("after.json")["train"].get<double>(), 1.0,
      1e-9);
}

TEST_F(Add, TakesTheModelAndTheScaleOfTheMotionFromATrial) {
  succeed({"add", "coulomb", "--at", "drive", "--trial", "trials/chirp", "--out", "new.yaml"});
  // 2 % of the root-mean-square speed, which is far from the 1 rad/s of a model without a trial
  const double speed = effect_of("new.yaml")["values"]["smoothing_speed"]["value"];
  EXPECT_GT(speed, 0.03);
  EXPECT_LT(speed, 3.0);
}

// It began with five times the link's mass, under which no legged robot stands.
TEST_F(Add, ALoadStartsAtAShareOfWhatCarriesIt) {
  succeed({"add", "payload", "--at", "arm", "--model", "robot/model.yaml", "--out", "new.yaml"});
  const double mass = effect_of("new.yaml")["values"]["mass"]["value"];
  constexpr double kCarrier = 1.2;  // kg, of the arm in its URDF
  EXPECT_GT(mass, 0.0);
  EXPECT_LT(mass, kCarrier);
}

TEST_F(Add, AReleasedRatioStartsAtAStiffnessThatFitCanMove) {
  succeed({"add", "cable_stretch", "--at", "shoulder", "--model", "robot/model.yaml", "--out", "new.yaml"});
  const json values = effect_of("new.yaml")["values"];
  EXPECT_GT(values["stiffness"]["value"].get<double>(), 0.0);
  EXPECT_LT(values["stiffness"]["value"].get<double>(), 100.0);
  EXPECT_EQ(read_json("model.json")["independent_coordinates"], 2);
}

TEST_F(Add, StandsOnAnOverlay) {
  succeed({"add", "coulomb", "--at", "drive", "--model", "robot/model.yaml", "--out", "one.yaml"});
  succeed({"add", "torque_bias", "--at", "drive", "--model", "one.yaml", "--out", "two.yaml"});
  succeed({"check", "two.yaml", "--json", "model.json"});
  EXPECT_EQ(read_json("model.json")["effects"].size(), 3U);
  EXPECT_EQ(read_json("model.json")["lineage"].size(), 3U);
}

TEST_F(Add, TakesSeveralEffectsInOneCall) {
  succeed({"add", "coulomb@drive:level=0.25", "torque_bias@drive", "--model", "robot/model.yaml", "--out",
           "two.yaml", "--json", "add.json"});
  succeed({"check", "two.yaml", "--json", "model.json"});
  const json effects = read_json("model.json")["effects"];
  ASSERT_EQ(effects.size(), 3U);
  EXPECT_EQ(effects[1]["values"]["level"]["value"], 0.25);
  EXPECT_EQ(effects[2]["effect"], "torque_bias");
  EXPECT_EQ(read_json("add.json")["effects"].size(), 2U);
}

TEST_F(Add, ThenFitFindsWhatWasHidden) {
  succeed({"add", "coulomb", "--at", "drive", "--trial", "trials/steps", "--set", "smoothing_speed=0.5",
           "--out", "new.yaml"});
  const Outcome outcome =
      succeed({"fit", "trials/chirp", "trials/steps", "trials/swing", "--model", "new.yaml", "--free",
               "coulomb@*:level", "--window", "0.25", "--out", "fitted.yaml", "--json", "fit.json"});
  const json fit = read_json("fit.json");
  ASSERT_EQ(fit["parameters"].size(), 1U);
  const json level = fit["parameters"][0];
  EXPECT_EQ(level["label"], "coulomb@drive:level");
  EXPECT_EQ(level["before"], 0.0);
  EXPECT_NEAR(level["after"].get<double>(), kHiddenLevel, 0.02 * kHiddenLevel);
  EXPECT_LT(level["interval"][0].get<double>(), kHiddenLevel);
  EXPECT_GT(level["interval"][1].get<double>(), kHiddenLevel);
  EXPECT_EQ(level["doubts"], json::array());
  EXPECT_LT(fit["after"]["train"].get<double>(), 1.2);
  EXPECT_LT(fit["after"]["held_out"].get<double>(), 1.2);
  EXPECT_GT(fit["before"]["held_out"].get<double>(), 20.0);
  EXPECT_THAT(outcome.out, HasSubstr("All of these parameters are identifiable from these data."));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("More is missing than values")));
  // The overlay is the fitted model: value, uncertainty, source.
  const json values = effect_of("fitted.yaml")["values"];
  EXPECT_DOUBLE_EQ(values["level"]["value"].get<double>(), level["after"].get<double>());
  EXPECT_DOUBLE_EQ(values["level"]["standard_deviation"].get<double>(),
                   level["standard_deviation"].get<double>());
  EXPECT_EQ(values["level"]["source"], "fit on chirp, steps");
  EXPECT_EQ(values["smoothing_speed"]["value"], 0.5);
}

TEST_F(Add, FitSaysWhenMoreIsMissing) {
  const Outcome outcome = succeed({"fit", "trials/chirp", "--free", "viscous@drive:*", "--window", "0.25"});
  EXPECT_THAT(outcome.out, HasSubstr("More is missing than values"));
}

TEST_F(Add, FitSaysWhatTheDataCannotTell) {
  // Two dampers on one gearbox: only their sum moves the pendulum.
  succeed({"add", "coulomb", "--at", "drive", "--model", "robot/model.yaml", "--set", "level=0.008", "--set",
           "smoothing_speed=0.5", "--out", "one.yaml"});
  succeed({"add", "viscous", "--at", "shoulder", "--model", "one.yaml", "--out", "two.yaml"});
  const Outcome outcome = succeed({"fit", "trials/chirp", "--model", "two.yaml", "--free", "viscous@*",
                                   "--window", "0.25", "--json", "fit.json"});
  const json fit = read_json("fit.json");
  ASSERT_EQ(fit["parameters"].size(), 2U);
  for (const json& parameter : fit["parameters"]) {
    std::vector<std::string> kinds;
    for (const json& doubt : parameter["doubts"]) {
      kinds.push_back(doubt["kind"]);
    }
    EXPECT_THAT(kinds, testing::Contains("tied")) << parameter;
  }
  EXPECT_THAT(outcome.out, HasSubstr("Not identifiable from these data, or hardly:"));
  EXPECT_THAT(outcome.out, HasSubstr("it cannot be told from viscous@shoulder:damping"));
}

}  // namespace
}  // namespace plumbline::test
