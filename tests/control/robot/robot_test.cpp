// The simulated robot: under the driver it moves as in a simulation of one piece, and it has a watchdog.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "simulator/run/run_scenario.h"
#include "simulator/run/sampled_run.h"
#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "tests/driver/rehearsal.h"
#include "tests/trace/temporary_folder.h"
#include "validation/control/robot/simulated_robot.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {
namespace {

using driver::Packet;
using test::TemporaryFolder;

constexpr int kSamples = 1200;  // two hops

RobotOptions options_of(bool real_time) {
  RobotOptions options;
  options.integrator = run::SampledOptions().integrator;
  options.real_time = real_time;
  options.patience = 10.0;
  return options;
}

/// A robot that serves in a thread until the test is over.
class Served {
 public:
  Served(const driver::Rehearsal& rehearsal, const std::string& address, const RobotOptions& options)
      : robot_(rehearsal.loaded().model, rehearsal.loaded().scenario.terrain,
               run::state_at_start(rehearsal.loaded().model, rehearsal.loaded().scenario), options),
        transport_(driver::open_transport(address, driver::Side::robot)),
        thread_([this] { report_ = robot_.serve(*transport_, [this] { return over_.load(); }); }) {}
  ~Served() { end(); }
  const RobotReport& end() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
    return report_;
  }

 private:
  SimulatedRobot robot_;
  std::unique_ptr<driver::Transport> transport_;
  std::atomic<bool> over_{false};
  RobotReport report_;
  std::thread thread_;
};

class Driven : public ::testing::TestWithParam<const char*> {};

// The same counts, sample by sample, as a simulation of one piece: nothing is lost, doubled or late by a
// sample between robot, wire, driver and controller.
TEST_P(Driven, MovesAsInOnePiece) {
  const TemporaryFolder folder;
  const driver::Rehearsal rehearsal(folder.path("."));
  const std::string address = std::string(GetParam()) == "udp"
                                  ? "udp:127.0.0.1:" + std::to_string(20000 + getpid() % 20000)
                                  : "shm:plumbline-robot-test-" + std::to_string(getpid());
  Served robot(rehearsal, address, options_of(false));
  driver::Process drive({DRIVE_PROGRAM, rehearsal.whole(), "--key", rehearsal.key(), "--robot", address,
                         "--log", folder.path("log"), "--allow-soft-timing", "--for", "1.5", "--do",
                         "wait 1; arm; wait 0.8; go; wait 60; quit"},
                        folder.path("drive.txt"));
  ASSERT_EQ(drive.wait(), 0) << folder.read("drive.txt");
  const RobotReport& report = robot.end();
  ASSERT_EQ(report.runs.size(), 1U);
  EXPECT_GE(report.runs[0].landings, 2);
  EXPECT_FALSE(report.runs[0].watchdog);

  LastingOptions options;
  options.cycles = 100;
  options.keep = kSamples;
  run::LoadedScenario loaded = rehearsal.loaded();
  loaded.scenario.longest = 1e-3 * kSamples;
  const LastingRun whole = last(loaded, read_gait(loaded).value(), rehearsal.plan(), options);
  const Table table = read_table(folder.path("log/data.csv"));
  ASSERT_GE(table.rows(), kSamples);
  for (std::size_t c = 0; c < rehearsal.plan().channels.size(); ++c) {
    const driver::Channel& channel = rehearsal.plan().channels[c];
    const std::string column =
        (channel.kind == driver::ChannelKind::contact ? "contact_" : "q_") + channel.name;
    const Column* driven = table.find(column);
    ASSERT_NE(driven, nullptr) << column;
    const auto index = static_cast<Eigen::Index>(c);
    for (Eigen::Index k = 0; k < kSamples; ++k) {
      ASSERT_EQ(std::round(driven->values[k] / channel.scale), whole.channels(index, k))
          << column << " at sample " << k;
    }
  }
  const Trial trial = read_trial(folder.path("log"), loaded.model);
  EXPECT_EQ(trial.samples(), table.rows());
  EXPECT_EQ(trial.switches.size(), loaded.model.switches.size());
}

INSTANTIATE_TEST_SUITE_P(Wires, Driven, ::testing::Values("udp", "shm"),
                         [](const auto& wire) { return std::string(wire.param); });

/// A driver that says what the test wants, and no more.
class Hand {
 public:
  Hand(const std::string& address, const driver::Plan& plan)
      : transport_(driver::open_transport(address, driver::Side::driver)) {
    command_.kind = Packet::commands;
    command_.session = 7;
    command_.layout = driver::layout_of(plan.channel_names(), plan.command_names());
    command_.count = static_cast<std::uint16_t>(plan.commands.size());
  }
  /// Sends, and takes the newest answer for so many packets.
  Packet say(std::uint32_t flags, int packets) {
    Packet newest;
    for (int k = 0; k < packets; ++k) {
      command_.flags = flags;
      ++command_.sequence;
      command_.echo = newest.sequence;
      std::uint8_t bytes[Packet::largest + 1];
      transport_->send(bytes, driver::encode(command_, bytes));
      transport_->wait(driver::monotonic_now() + 5000000);
      while (const std::size_t size = transport_->receive(bytes, sizeof bytes)) {
        driver::decode(bytes, size, newest);
      }
    }
    return newest;
  }

 private:
  std::unique_ptr<driver::Transport> transport_;
  Packet command_;
};

// Without a command in time the motors lose their power by themselves, and do not get it back until a reset.
TEST(Robot, ItsWatchdogCutsThePower) {
  namespace robot_flag = driver::robot_flag;
  namespace driver_flag = driver::driver_flag;
  const TemporaryFolder folder;
  const driver::Rehearsal rehearsal(folder.path("."));
  const std::string address = "shm:plumbline-watchdog-" + std::to_string(getpid());
  RobotOptions options = options_of(true);
  options.watchdog = 0.1;
  Served robot(rehearsal, address, options);
  Hand hand(address, rehearsal.plan());
  EXPECT_EQ(hand.say(0, 5).flags & robot_flag::power, 0U);
  EXPECT_NE(hand.say(driver_flag::power, 5).flags & robot_flag::power, 0U);
  hand.say(driver_flag::power | driver_flag::running, 5);
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  const Packet after = hand.say(driver_flag::power, 5);
  EXPECT_EQ(after.flags & robot_flag::power, 0U);
  EXPECT_NE(after.flags & robot_flag::tripped, 0U);
  EXPECT_EQ(hand.say(driver_flag::reset, 5).flags & robot_flag::tripped, 0U);
  EXPECT_NE(hand.say(driver_flag::power, 5).flags & robot_flag::power, 0U);
  const RobotReport& report = robot.end();
  ASSERT_EQ(report.runs.size(), 1U);
  EXPECT_TRUE(report.runs[0].watchdog);
  EXPECT_GE(report.runs[0].watchdog_after, 0.1);
  EXPECT_LT(report.runs[0].watchdog_after, 1.0);  // what a loaded computer may add
}

TEST(WireFault, IsReadAndRefused) {
  const run::LoadedScenario loaded =
      run::read_scenario(PLUMBLINE_ROOT "/robots/mabel/scenarios/hopping_boom.yaml");
  const WireFault drift = parse_fault("drift@1.5:knee_left:300", loaded.model);
  EXPECT_EQ(drift.kind, WireFault::Kind::drift);
  EXPECT_EQ(drift.time, 1.5);
  EXPECT_EQ(drift.amount, 300.0);
  EXPECT_EQ(drift.channel, loaded.model.sensor_index("knee_left"));
  for (const char* wrong :
       {"drfit@1:knee_left", "drift@1", "drift@1:kne_left", "lost", "lost@x", "lost@1:2:3"}) {
    EXPECT_THROW(parse_fault(wrong, loaded.model), InputError) << wrong;
  }
}

}  // namespace
}  // namespace plumbline::validation
