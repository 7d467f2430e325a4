// The machine-readable layouts of docs/formats.md.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

using nlohmann::json;
using testing::UnorderedElementsAre;

class Json : public RobotFolder {
 protected:
  json from(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--json", "out.json"});
    succeed(arguments);
    return read_json("out.json");
  }
};

json named(const json& list, const std::string& key, const std::string& name) {
  for (const json& item : list) {
    if (item[key] == name) {
      return item;
    }
  }
  ADD_FAILURE() << "no " << name << " in " << list;
  return {};
}

TEST_F(Json, Effects) {
  const json all = from({"effects"});
  EXPECT_THAT(keys(all), UnorderedElementsAre("effects"));
  EXPECT_GT(all["effects"].size(), 20U);
  const json stretch = named(all["effects"], "name", "cable_stretch");
  EXPECT_THAT(keys(stretch), UnorderedElementsAre("name", "summary", "equation", "source", "states",
                                                  "power_note", "places", "parameters"));
  EXPECT_EQ(stretch["places"], json::array({"ratio"}));
  const json stiffness = named(stretch["parameters"], "name", "stiffness");
  EXPECT_THAT(keys(stiffness), UnorderedElementsAre("name", "meaning", "rotary_unit", "linear_unit",
                                                    "null_value", "lower", "upper", "scale", "structural"));
  EXPECT_EQ(stiffness["rotary_unit"], "N m/rad");
  EXPECT_EQ(stiffness["linear_unit"], "N/m");
  EXPECT_EQ(stiffness["null_value"], "inf");
  EXPECT_EQ(stiffness["scale"], "reciprocal");
  EXPECT_EQ(from({"effects", "cable_stretch"})["effects"], json::array({stretch}));
}

TEST_F(Json, CheckOfAModel) {
  const json model = from({"check", "robot/model.yaml"});
  EXPECT_THAT(keys(model),
              UnorderedElementsAre("kind", "file", "robot", "lineage", "skeleton", "independent_coordinates",
                                   "states", "bodies", "coordinates", "motors", "pulleys", "ratios",
                                   "inertias", "contacts", "loops", "effects", "sensors", "contact_switches",
                                   "places", "meshes"));
  EXPECT_EQ(model["kind"], "model");
  EXPECT_EQ(model["independent_coordinates"], 1);
  EXPECT_EQ(model["states"], 2);
  EXPECT_EQ(model["ratios"][0]["to"], json({{"shoulder", 50.0}}));
  const json damping = model["effects"][0]["values"]["damping"];
  EXPECT_THAT(keys(damping),
              UnorderedElementsAre("value", "standard_deviation", "unit", "source", "assumed"));
  EXPECT_EQ(damping["value"], 1e-4);
  EXPECT_DOUBLE_EQ(damping["standard_deviation"], 0.5e-4);  // 50 %
  EXPECT_EQ(damping["unit"], "N m s/rad");
  const json sensor = named(model["sensors"], "name", "drive");
  EXPECT_THAT(keys(sensor), UnorderedElementsAre("name", "measures", "unit", "resolution", "noise", "floor"));
  constexpr double turn = 6.283185307179586;
  EXPECT_NEAR(sensor["floor"], turn / 4096 / std::sqrt(12.0), 1e-12);
  EXPECT_THAT(keys(model["places"]), UnorderedElementsAre("coordinate", "motor", "ratio", "body", "sensor",
                                                          "world", "foot", "base", "contact switch", "limb"));
  EXPECT_EQ(model["places"]["ratio"], json::array({"shoulder"}));
}

TEST_F(Json, CheckOfATrial) {
  const json trial = from({"check", "trials/steps"});
  EXPECT_THAT(keys(trial),
              UnorderedElementsAre("kind", "file", "title", "model", "data", "role", "samples", "period",
                                   "duration", "independent_coordinates", "events", "measured", "commands",
                                   "locked", "controllers", "contact_events"));
  EXPECT_EQ(trial["kind"], "trial");
  EXPECT_EQ(trial["role"], "train");
  EXPECT_EQ(trial["samples"], 1000);
  EXPECT_NEAR(trial["duration"], 1.998, 1e-9);
  EXPECT_THAT(keys(trial["measured"][0]),
              UnorderedElementsAre("sensor", "column", "column_unit", "unit", "rms", "floor"));
  EXPECT_THAT(keys(trial["commands"][0]),
              UnorderedElementsAre("motor", "column", "column_unit", "unit", "rms"));
  // 0 A for 50 samples, 0.4 A for 350, -0.3 A for 300, 0.5 A for 300
  EXPECT_NEAR(trial["commands"][0]["rms"], std::sqrt(0.35 * 0.16 + 0.3 * 0.09 + 0.3 * 0.25), 1e-9);
}

TEST_F(Json, Compare) {
  const json compared = from({"compare", "trials/steps", "trials/swing"});
  EXPECT_THAT(keys(compared), UnorderedElementsAre("train", "held_out", "channels", "windows", "phases",
                                                   "horizons", "lost", "test", "switches", "defects"));
  EXPECT_THAT(keys(compared["horizons"][0]),
              UnorderedElementsAre("trial", "channel", "role", "unit", "horizon", "rms", "windows", "lost"));
  ASSERT_EQ(compared["channels"].size(), 4U);
  EXPECT_THAT(keys(compared["channels"][0]),
              UnorderedElementsAre("trial", "name", "unit", "role", "rms", "floor", "ratio"));
  ASSERT_EQ(compared["windows"].size(), 8U);  // two times 2 s in windows of 0.5 s
  EXPECT_THAT(keys(compared["windows"][0]),
              UnorderedElementsAre("trial", "from", "to", "ratio", "worst_channel"));
  EXPECT_GE(compared["windows"][0]["ratio"], compared["windows"][7]["ratio"]);
  EXPECT_THAT(keys(compared["phases"][0]), UnorderedElementsAre("trial", "channel", "unit", "group", "phase",
                                                                "share", "rms", "mean", "ratio"));
  double share = 0.0;
  for (const json& one : compared["phases"]) {
    const bool mine = one["trial"] == "steps" && one["group"] == "speed" &&
                      one["channel"] == compared["phases"][0]["channel"];
    share += mine ? one["share"].get<double>() : 0.0;
  }
  EXPECT_NEAR(share, 1.0, 1e-9);
}

TEST_F(Json, Simulate) {
  const json simulated = from({"simulate", "trials/steps", "--out", "trace.csv"});
  EXPECT_THAT(keys(simulated), UnorderedElementsAre("model", "trial", "closed_loop", "samples", "duration",
                                                    "summary", "energy", "channels", "trace"));
  EXPECT_THAT(
      keys(simulated["summary"]),
      UnorderedElementsAre("method", "relative_tolerance", "steps", "error_test_failures", "rate_evaluations",
                           "jacobian_evaluations", "roots", "restarts", "wall_time_per_simulated_second"));
  EXPECT_THAT(keys(simulated["energy"]), UnorderedElementsAre("error", "exchanged", "relative_error"));
  EXPECT_THAT(keys(simulated["channels"][0]), UnorderedElementsAre("name", "unit", "rms", "floor"));
}

TEST_F(Json, Fit) {
  const json fitted =
      from({"fit", "trials/steps", "--free", "*", "--window", "0.25", "--out", "fitted.yaml"});
  EXPECT_THAT(keys(fitted),
              UnorderedElementsAre("model", "trials", "before", "after", "windows", "confidence",
                                   "iterations", "converged", "parameters", "saved", "whole"));
  EXPECT_EQ(fitted["windows"], 8);
  EXPECT_TRUE(fitted["after"]["held_out"].is_null());
  ASSERT_EQ(fitted["parameters"].size(), 1U);
  EXPECT_THAT(keys(fitted["parameters"][0]),
              UnorderedElementsAre("label", "unit", "before", "after", "standard_deviation",
                                   "degrees_of_freedom", "interval", "partner", "correlation", "doubts"));
  EXPECT_EQ(fitted["parameters"][0]["interval"].size(), 2U);
  EXPECT_LE(fitted["parameters"][0]["degrees_of_freedom"], 7.0 + 1e-6);
  EXPECT_GT(fitted["parameters"][0]["degrees_of_freedom"], 2.0);
}

TEST_F(Json, Add) {
  const json added = from({"add", "stribeck", "--at", "drive", "--model", "robot/model.yaml", "--set",
                           "level=0.1", "--out", "new.yaml"});
  EXPECT_THAT(keys(added), UnorderedElementsAre("file", "base", "effect", "at", "changes_nothing", "values"));
  EXPECT_EQ(added["changes_nothing"], false);
  const json level = named(added["values"], "name", "level");
  EXPECT_THAT(keys(level), UnorderedElementsAre("name", "value", "unit", "set", "structural"));
  EXPECT_EQ(level["value"], 0.1);
  EXPECT_EQ(level["set"], true);
  EXPECT_EQ(named(added["values"], "name", "rise")["set"], false);
}

TEST_F(Json, NewTrialAndTwin) {
  EXPECT_EQ(from({"new-trial", "mine"}),
            json({{"folder", "mine"}, {"files", {"trial.yaml", "data.csv", "README.md"}}}));
  const json twin = from(
      {"twin", "--model", "robot/model.yaml", "--experiment", "experiments/steps.yaml", "--out", "again"});
  EXPECT_EQ(twin, json({{"trials", {"again/steps"}}}));
}

TEST_F(Json, FileIsReplacedAsAWhole) {
  write("out.json", std::string(100000, 'x'));
  EXPECT_EQ(from({"effects", "viscous"})["effects"].size(), 1U);
}

}  // namespace
}  // namespace plumbline::test
