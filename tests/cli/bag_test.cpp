// Recordings of ROS through the real program: what they hold, trials from them, and what is wrong with them.
#include <gmock/gmock.h>

#include "simulator/trace/table.h"
#include "tests/cli/bad_input.h"
#include "tests/trace/cdr.h"
#include "tests/trace/mcap_writer.h"

namespace plumbline::test {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kStart = 1600000000000000000;  // ns

std::uint64_t nanoseconds(double seconds) { return static_cast<std::uint64_t>(std::llround(1e9 * seconds)); }

/// Half a second of a recording as a robot's computers would have written it: joint states with a header, and
/// commands without one, each 0.1 ms after it was held.
std::string bag_of(const std::string& csv, const McapLayout& layout) {
  const Table table = read_csv(csv);
  const auto at = [&](const char* name, Eigen::Index k) { return table.find(name)->values[k]; };
  std::vector<McapMessage> messages;
  for (Eigen::Index k = 0; k < table.rows(); ++k) {
    const std::uint64_t time = nanoseconds(at("t", k));
    Cdr command;
    command.put<std::uint32_t>(0).put<std::uint32_t>(0).put<std::uint32_t>(1).put(at("u_drive", k));
    messages.push_back({1, kStart + time, command.bytes()});
    Cdr state;
    state.put<std::int32_t>(static_cast<std::int32_t>(1600000000 + time / 1000000000));
    state.put(static_cast<std::uint32_t>(time % 1000000000)).text("");
    state.put<std::uint32_t>(2).text("drive").text("shoulder");
    state.put<std::uint32_t>(2).put(at("q_drive", k)).put(at("q_shoulder", k));
    state.put<std::uint32_t>(0).put<std::uint32_t>(0);
    messages.push_back({0, kStart + time + 100000, state.bytes()});
  }
  return mcap_file({{"/joint_states", "sensor_msgs/msg/JointState", kJointStateDefinition},
                    {"/command", "std_msgs/msg/Float64MultiArray", ""},
                    {"/rosout", "rcl_interfaces/msg/Log", "string msg\n"}},
                   messages, layout);
}

constexpr const char* kFromBag = R"(plumbline: trial/1
title: Steps, from a bag
model: ../../robot/model.yaml
role: train
data: steps.mcap
topic: /joint_states
time: {column: log_time, unit: s}
commands:
  drive: {topic: /command, column: data.1, unit: A}
measured:
  drive: {column: position.drive, unit: rad}
  shoulder: {column: position.shoulder, unit: rad}
)";

class Bags : public RobotFolder {
 protected:
  void SetUp() override {
    RobotFolder::SetUp();
    McapLayout layout;
    layout.compression = "zstd";
    layout.per_chunk = 100;
    write("bags/steps/steps.mcap", bag_of(folder + "/trials/steps/data.csv", layout));
  }
};

/// All numbers of two JSON texts of one shape, up to what clocks of 2e-7 s and a first row 0.1 ms late do.
void expectNear(const nlohmann::json& a, const nlohmann::json& b) {
  constexpr double kSame = 2e-3;
  if (a.is_number()) {
    EXPECT_NEAR(a.get<double>(), b.get<double>(), kSame * std::abs(a.get<double>()) + 1e-9);
  }
  if (a.is_structured()) {
    ASSERT_EQ(a.size(), b.size());
    for (auto one = a.begin(), other = b.begin(); one != a.end(); ++one, ++other) {
      expectNear(*one, *other);
    }
  }
}

TEST_F(Bags, aTrialFromTwoTopicsIsTheTrialThatItWas) {
  write("trials/bag/trial.yaml", kFromBag);
  write("trials/bag/steps.mcap", read("bags/steps/steps.mcap"));
  succeed({"compare", "trials/steps", "--json", "csv.json"});
  const Outcome outcome = succeed({"compare", "trials/bag", "--json", "bag.json"});
  const nlohmann::json of_csv = read_json("csv.json");
  const nlohmann::json of_bag = read_json("bag.json");
  expectNear(of_csv.at("train"), of_bag.at("train"));
  expectNear(of_csv.at("channels"), of_bag.at("channels"));
}

TEST_F(Bags, newTrialReadsTopicsOfAFolderAndCheckTakesWhatItWrote) {
  const Outcome listed = plumbline({"new-trial", "trials/new", "--from", "bags/steps"});
  EXPECT_EQ(listed.status, 2);
  EXPECT_THAT(listed.err, HasSubstr("2 topics that fit, expected one of: /joint_states (sensor_msgs/msg/"));
  EXPECT_THAT(listed.err, HasSubstr(", 500 Hz), /command (std_msgs/msg/Float64MultiArray, "));
  EXPECT_EQ(listed.out, "");
  succeed({"new-trial", "trials/new", "--from", "bags/steps", "--model", "robot/model.yaml", "--topic",
           "/joint_states", "/command"});
  const std::string text = read("trials/new/trial.yaml");
  EXPECT_THAT(text, HasSubstr("\ntopic: \"/joint_states\" "));
  EXPECT_THAT(text, HasSubstr("time: {column: header.stamp, unit: s}"));
  EXPECT_THAT(text, HasSubstr("drive: {topic: \"/command\", column: data.1, unit: A}"));
  EXPECT_THAT(text, HasSubstr("shoulder: {column: position.shoulder, unit: rad}"));
  replace("trials/new/trial.yaml", "position.drive, unit: deg",
          "position.drive, unit: rad");  // a wrong guess
  EXPECT_THAT(succeed({"check", "trials/new"}).out, HasSubstr("/command are brought to the rows of"));
}

TEST_F(Bags, newModelFindsAJointsColumns) {
  succeed({"new-model", "robot/pendulum_drive.urdf", "--from", "bags/steps/steps.mcap", "--topic",
           "/joint_states", "-o", "new.yaml", "--json", "made.json"});
  EXPECT_EQ(read_json("made.json")["joints"].at(0)["position"], "/joint_states.position.shoulder");
}

std::string small_bag(const McapLayout& layout = {},
                      const McapTopic& first = {"/joint_states", "sensor_msgs/msg/JointState",
                                                kJointStateDefinition}) {
  std::vector<McapMessage> messages;
  for (std::uint32_t k = 0; k < 30; ++k) {
    messages.push_back({0, kStart + 2000000 * k, joint_state(2000000 * k, 0.0, 0.0)});
  }
  return mcap_file({first}, messages, layout);
}

McapLayout packed_in(const std::string& compression) {
  McapLayout layout;
  layout.compression = compression;
  return layout;
}

McapLayout with_bad_crc() {
  McapLayout layout;
  layout.spoil_chunk_crc = true;
  return layout;
}

BadInput bad_bag(const std::string& name, const std::string& bytes, const std::vector<std::string>& message) {
  return {name,
          {{"bag.mcap", "", bytes}},
          {"new-trial", "trials/new", "--from", "bag.mcap", "--topic", "/joint_states"},
          message};
}

INSTANTIATE_TEST_SUITE_P(
    Bags, BadInputs,
    testing::Values(
        bad_bag("cut_off", small_bag().substr(0, 2000), {"bag.mcap: found a recording that was cut off"}),
        bad_bag("no_mcap", "rosbag 2.0 or so", {"bag.mcap: found a file without MCAP's first bytes"}),
        bad_bag("crc", small_bag(with_bad_crc()),
                {"bag.mcap: found a chunk whose CRC does not agree at byte"}),
        bad_bag("compression", small_bag(packed_in("brotli")),
                {"bag.mcap: found a chunk in \"brotli\"", "expected lz4, zstd or no compression"}),
        bad_bag("no_such_topic", small_bag({}, {"/joints", "sensor_msgs/msg/JointState", ""}),
                {"bag.mcap: /joint_states: found no such topic, expected one of: /joints (sensor_msgs"}),
        bad_bag("encoding", small_bag({}, {"/joint_states", "foxglove.Joints", "", "protobuf", "protobuf"}),
                {"bag.mcap: /joint_states: found messages in protobuf, expected cdr"}),
        bad_bag("definition", small_bag({}, {"/joint_states", "my/msg/Joints", "struct", "cdr", "omgidl"}),
                {"bag.mcap: /joint_states: found a definition of my/msg/Joints in omgidl, expected one in"}),
        bad_bag("message_ends_early", small_bag({}, {"/joint_states", "nav_msgs/msg/Odometry", ""}),
                {"bag.mcap: /joint_states: found a message that ends early"}),
        BadInput{"topic_of_a_table",
                 {{kTrial, "data: data.csv", "data: data.csv\ntopic: /joint_states"}},
                 kCompare,
                 {"trial.yaml:", "topic: found a topic of", "data.csv, expected `topic` for a bag"}},
        BadInput{"topic_option_of_a_table",
                 {},
                 {"new-trial", "trials/new", "--from", kData, "--topic", "/joint_states"},
                 {"data.csv: found a topic of a file that is no bag"}},
        BadInput{"folder_without_a_bag",
                 {},
                 {"new-trial", "trials/new", "--from", "experiments"},
                 {"experiments: found a folder with 0 bags, expected"}},
        BadInput{"field_of_no_message",
                 {{"trials/steps/bag.mcap", "", small_bag()},
                  {kTrial, "", kFromBag},
                  {kTrial, "steps.mcap", "bag.mcap"},
                  {kTrial, "{topic: /command, column: data.1", "{column: effort.hip"}},
                 kCompare,
                 {"trial.yaml:", "found column \"/joint_states.position.drive\", expected a column of"}},
        BadInput{"topic_of_a_column",
                 {{"trials/steps/bag.mcap", "", small_bag()},
                  {kTrial, "", kFromBag},
                  {kTrial, "steps.mcap", "bag.mcap"}},
                 kCompare,
                 {"bag.mcap: /command.data.1: found no such topic, expected one of: /joint_states ("}}),
    name_of);

}  // namespace
}  // namespace plumbline::test
