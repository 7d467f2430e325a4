#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "simulator/trace/error.h"
#include "simulator/trace/log_file.h"
#include "tests/trace/cdr.h"

namespace plumbline {
namespace {

using test::joint_state;

std::string write_bag(const std::string& name, const std::string& second_message) {
  const std::string path = testing::TempDir() + name;
  std::remove(path.c_str());
  sqlite3* base = nullptr;
  sqlite3_open(path.c_str(), &base);
  sqlite3_exec(
      base,
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);"
      "INSERT INTO topics VALUES(1, '/joints', 'sensor_msgs/msg/JointState', 'cdr');"
      "INSERT INTO topics VALUES(2, '/log', 'rcl_interfaces/msg/Log', 'cdr');",
      nullptr, nullptr, nullptr);
  std::int64_t time = 1600000001000000000;
  for (const std::string& message : {joint_state(0, 0.25, -1.5), second_message}) {
    sqlite3_stmt* row = nullptr;
    sqlite3_prepare_v2(base, "INSERT INTO messages(topic_id, timestamp, data) VALUES(1, ?, ?)", -1, &row,
                       nullptr);
    sqlite3_bind_int64(row, 1, time);
    sqlite3_bind_blob(row, 2, message.data(), static_cast<int>(message.size()), SQLITE_TRANSIENT);
    sqlite3_step(row);
    sqlite3_finalize(row);
    time += 10000000;
  }
  sqlite3_close(base);
  return path;
}

TEST(Rosbag, jointsByNameAndBothClocks) {
  const LogFile log = read_log(write_bag("joints.db3", joint_state(500000000, 0.5, 2.0)));
  ASSERT_NE(log.table.find("/joints.position.knee"), nullptr);
  EXPECT_EQ(log.table.find("/joints.position.hip")->values, Eigen::Vector2d(0.25, 0.5));
  EXPECT_EQ(log.table.find("/joints.position.knee")->values, Eigen::Vector2d(-1.5, 2.0));
  EXPECT_EQ(log.table.find("/joints.header.stamp")->values, Eigen::Vector2d(1600000000, 1600000000.5));
  EXPECT_NEAR(log.table.find("/joints.log_time")->values[1], 1600000001.01, 1e-6);
}

TEST(Rosbag, refusesWhatIsCutOffOrNotThere) {
  const std::string whole = joint_state(0, 0.5, 2.0);
  EXPECT_THROW(read_log(write_bag("cut.db3", whole.substr(0, 60))), InputError);
  try {
    read_log(write_bag("topic.db3", whole), {{}, {"/wrench.force.x"}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/joints (sensor_msgs/msg/JointState, 2, 100 Hz)"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace plumbline
