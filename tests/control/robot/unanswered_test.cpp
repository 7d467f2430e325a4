// The driver where no robot is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/driver/rehearsal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::validation {
namespace {

TEST(Unanswered, DriveSaysSoAndFails) {
  const test::TemporaryFolder folder;
  const driver::Rehearsal rehearsal(folder.path("."));
  const std::string address = "udp:127.0.0.1:" + std::to_string(20000 + getpid() % 20000);
  driver::Process drive({DRIVE_PROGRAM, rehearsal.whole(), "--key", rehearsal.key(), "--robot", address,
                         "--log", folder.path("log"), "--allow-soft-timing", "--do", "wait 0.3; quit"},
                        folder.path("drive.txt"));
  EXPECT_EQ(drive.wait(), 1);
  EXPECT_THAT(folder.read("drive.txt"),
              testing::HasSubstr("drive: no robot answered at " + address + ": 0 packets came"));
}

}  // namespace
}  // namespace plumbline::validation
