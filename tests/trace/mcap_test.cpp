#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "simulator/trace/bag.h"
#include "simulator/trace/log_file.h"
#include "tests/trace/cdr.h"
#include "tests/trace/mcap_writer.h"
#include "tests/trace/refusal.h"

namespace plumbline {
namespace {

using test::Cdr;
using test::joint_state;
using test::mcap_file;
using test::McapLayout;
using test::McapMessage;
using test::McapTopic;
using test::refusal;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint64_t kStart = 1600000001000000000;
constexpr std::uint64_t kStep = 10000000;
constexpr long kRows = 8;

std::string saved(const std::string& name, const std::string& bytes) {
  std::string path = testing::TempDir() + name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::vector<McapTopic> topics() {
  return {{"/joints", "sensor_msgs/msg/JointState", test::kJointStateDefinition},
          {"/rosout", "rcl_interfaces/msg/Log", "string msg\n"},
          {"/camera", "foxglove.Image", "", "protobuf", "protobuf"}};
}

/// Joint states at 100 Hz, in the reverse order of their receipt in pairs, as buffers make it; a log between.
std::vector<McapMessage> messages() {
  std::vector<McapMessage> all;
  for (std::uint32_t k = 0; k < kRows; ++k) {
    const std::uint32_t swapped = k ^ 1U;
    all.push_back(
        {0, kStart + swapped * kStep, joint_state(swapped * 10000000, 0.25 * swapped, -1.0 * swapped)});
    all.push_back({1, kStart + k * kStep, Cdr().text("all is well").bytes()});
  }
  all.push_back({2, kStart, "\x01"});
  return all;
}

void expectJoints(const LogFile& log) {
  ASSERT_NE(log.table.find("/joints.position.knee"), nullptr);
  ASSERT_EQ(log.table.rows(), kRows);
  for (Eigen::Index k = 0; k < kRows; ++k) {
    const auto at = static_cast<double>(k);
    EXPECT_EQ(log.table.find("/joints.position.hip")->values[k], 0.25 * at);
    EXPECT_EQ(log.table.find("/joints.position.knee")->values[k], -at);
    EXPECT_NEAR(log.table.find("/joints.header.stamp")->values[k], 1600000000.0 + 0.01 * at, 3e-7);
    EXPECT_NEAR(log.table.find("/joints.log_time")->values[k], 1600000001.0 + 0.01 * at, 3e-7);
  }
}

TEST(Mcap, everyLayoutGivesTheSameRows) {
  for (const bool summary : {true, false}) {
    for (const bool crc : {true, false}) {
      McapLayout layout;
      layout.summary = summary;
      layout.crc = crc;
      for (const char* compression : {"", "lz4", "zstd"}) {
        layout.compression = compression;
        SCOPED_TRACE(std::string(compression) + (summary ? " with a summary" : " without a summary"));
        expectJoints(read_log(saved("layout.mcap", mcap_file(topics(), messages(), layout))));
      }
      layout.chunks = false;
      expectJoints(read_log(saved("layout.mcap", mcap_file(topics(), messages(), layout))));
    }
  }
}

TEST(Mcap, theIndexLeavesOutChunksWithoutTheTopic) {
  // The last message, of another topic, fills a chunk alone; what it holds is spoilt, and nobody looks.
  McapLayout layout;
  layout.per_chunk = 2 * kRows;
  std::string bytes = mcap_file(topics(), messages(), layout);
  const std::size_t last = bytes.rfind(std::string("\x05\x17\0\0\0\0\0\0\0\x03", 10));
  ASSERT_NE(last, std::string::npos);
  bytes[last + 1] = '\x01';
  expectJoints(read_log(saved("index.mcap", bytes)));
  layout.summary = false;
  bytes = mcap_file(topics(), messages(), layout);
  bytes[bytes.rfind(std::string("\x05\x17\0\0\0\0\0\0\0\x03", 10)) + 1] = '\x01';
  EXPECT_THAT(refusal([&] { read_log(saved("index.mcap", bytes)); }), HasSubstr("CRC does not agree"));
}

TEST(Mcap, aTypeThatOnlyTheFileKnows) {
  const std::string definition =
      "uint8 READY=1\nstring LABEL='a=b'\nLeg[2] legs\nfloat32[<=3] currents\nbool on true\n" +
      std::string(80, '=') + "\nMSG: my_robot/Leg\nint16 counts\ngeometry_msgs/Point foot\n" +
      std::string(80, '=') + "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n";
  Cdr cdr;
  cdr.put<std::int16_t>(-3).put(1.0).put(2.0).put(3.0);
  cdr.put<std::int16_t>(7).put(4.0).put(5.0).put(6.0);
  cdr.put<std::uint32_t>(2).put(0.5F).put(1.5F).put<std::uint8_t>(1);
  const std::vector<McapMessage> two{{0, kStart, cdr.bytes()}, {0, kStart + kStep, cdr.bytes()}};
  const LogFile log = read_log(
      saved("own.mcap", mcap_file({{"/legs", "my_robot/msg/Legs", definition}}, two)), {{}, {"/legs.on"}});
  EXPECT_EQ(log.table.find("/legs.legs.1.counts")->values[1], -3.0);
  EXPECT_EQ(log.table.find("/legs.legs.2.foot.z")->values[1], 6.0);
  EXPECT_EQ(log.table.find("/legs.currents.2")->values[0], 1.5);
  EXPECT_EQ(log.table.find("/legs.on")->values[0], 1.0);
}

/// ROS 1: no alignment, no closing zeros, a header with a number, and a time of its own.
TEST(Mcap, messagesOfRos1) {
  const std::string definition =
      "Header header\ngeometry_msgs/Wrench wrench\n" + std::string(80, '=') +
      "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n" + std::string(80, '=') +
      "\nMSG: geometry_msgs/Wrench\ngeometry_msgs/Vector3 force\n" + std::string(80, '=') +
      "\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";
  const double force[3] = {1.0, 2.0, 300.0};
  std::string message("\x07\0\0\0\x0a\0\0\0\0\x65\xcd\x1d\x03\0\0\0toe", 19);  // number 7, 10.5 s
  message.append(reinterpret_cast<const char*>(force), sizeof force);
  const std::vector<McapMessage> two{{0, kStart, message}, {0, kStart + kStep, message}};
  const LogFile log = read_log(
      saved("ros1.mcap",
            mcap_file({{"/foot", "geometry_msgs/WrenchStamped", definition, "ros1", "ros1msg"}}, two)));
  EXPECT_EQ(log.table.find("/foot.header.stamp")->values[0], 10.5);
  EXPECT_EQ(log.table.find("/foot.wrench.force.z")->values[1], 300.0);
}

TEST(Mcap, aTypeThatHoldsItselfHasAnEnd) {
  const std::vector<McapMessage> two{{0, kStart, Cdr().put(1.0).bytes()},
                                     {0, kStart, Cdr().put(1.0).bytes()}};
  const std::string path = saved("self.mcap", mcap_file({{"/a", "p/msg/A", "A again\n"}}, two));
  EXPECT_THAT(refusal([&] { read_log(path); }), HasSubstr("/a: found types that hold each other"));
}

/// Commands at another rate: held to the rows of what was measured; what is measured goes by straight lines.
TEST(Mcap, aSecondTopicIsBroughtToTheRowsOfTheFirst) {
  std::vector<McapTopic> two = topics();
  two.push_back({"/command", "std_msgs/msg/Float64MultiArray", ""});
  std::vector<McapMessage> all = messages();
  for (std::uint32_t k = 0; k < 4; ++k) {
    Cdr cdr;
    cdr.put<std::uint32_t>(0).put<std::uint32_t>(0).put<std::uint32_t>(2).put(1.0 * k).put(10.0 * k);
    all.push_back({3, kStart + kStep / 2 + 2 * kStep * k, cdr.bytes()});
  }
  LogQuestion question;
  question.wanted = {"/joints.header.stamp", "/joints.position.hip", "/command.data.1", "/command.data.2"};
  question.held = {"/command.data.1"};
  const LogFile log = read_log(saved("two.mcap", mcap_file(two, all)), question);
  const Eigen::VectorXd& held = log.table.find("/command.data.1")->values;
  const Eigen::VectorXd& between = log.table.find("/command.data.2")->values;
  EXPECT_TRUE(std::isnan(held[0]));  // nothing was commanded yet
  EXPECT_EQ(Eigen::VectorXd(held.tail(7)), (Eigen::VectorXd(7) << 0, 0, 1, 1, 2, 2, 3).finished());
  EXPECT_NEAR(between[3], 12.5, 5e-4);  // a quarter of the way from 10 to 20; stamps are good to 2e-7 s
  EXPECT_EQ(log.bad.count("/command.data.1"), 1U);
  EXPECT_THAT(log.remarks, ElementsAre(HasSubstr("/joints by the time of receipt")));
}

TEST(Mcap, whatIsDamagedIsRefused) {
  const auto refused = [](const McapLayout& layout, const std::string& name = "bad.mcap") {
    return refusal([&] { read_log(saved(name, mcap_file(topics(), messages(), layout))); });
  };
  McapLayout layout;
  layout.spoil_chunk_crc = true;
  EXPECT_THAT(refused(layout), AllOf(HasSubstr("bad.mcap: found a chunk whose CRC"), HasSubstr("at byte ")));
  layout = {};
  layout.spoil_summary_crc = true;
  EXPECT_THAT(refused(layout), HasSubstr("a summary whose CRC does not agree"));
  layout = {};
  layout.summary = false;
  layout.spoil_data_crc = true;
  EXPECT_THAT(refused(layout), HasSubstr("data whose CRC does not agree"));
  layout = {};
  layout.compression = "brotli";
  EXPECT_THAT(refused(layout), AllOf(HasSubstr("a chunk in \"brotli\""), HasSubstr("lz4, zstd or no")));
}

/// Cut after any byte, with any byte another: an answer or one line, never a crash (and no endless memory).
TEST(Mcap, nothingThatIsInAFileCrashesTheReader) {
  for (const char* compression : {"", "lz4", "zstd"}) {
    McapLayout layout;
    layout.compression = compression;
    layout.crc = false;  // else the CRC alone would refuse them
    const std::string whole = mcap_file(topics(), messages(), layout);
    for (std::size_t i = 0; i < whole.size(); i += 31) {
      EXPECT_NE(refusal([&] { read_log(saved("cut.mcap", whole.substr(0, i))); }), "") << i;
      std::string spoilt = whole;
      spoilt[i] = static_cast<char>(spoilt[i] ^ 0xff);
      try {
        read_log(saved("spoilt.mcap", spoilt));
      } catch (const InputError&) {  // as it should be
      }
    }
  }
}

}  // namespace
}  // namespace plumbline
