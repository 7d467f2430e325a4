// The supervisor without a robot: each cause, at its limit and beyond.
#include "controllers/driver/supervisor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/driver/small_plan.h"

namespace plumbline::driver {
namespace {

class SupervisorTest : public ::testing::Test {
 protected:
  SupervisorTest() : supervisor_(small_plan()) {}

  void sensors(double counts, double tilt = 0.0, double foot = 0.0, std::uint32_t periods = 1,
               bool moving = true) {
    const double channels[] = {counts, tilt, foot};
    supervisor_.sensors(channels, periods, moving);
  }
  double command(double value) {
    supervisor_.command(&value);
    return value;
  }
  Cause cause() const { return supervisor_.fault().cause; }

  Supervisor supervisor_;
};

TEST_F(SupervisorTest, LetsGoodCommandsPass) {
  sensors(0);
  sensors(1);
  EXPECT_EQ(command(2.5), 2.5);
  EXPECT_FALSE(supervisor_.stopped());
}

TEST_F(SupervisorTest, NotANumber) {
  EXPECT_EQ(command(std::nan("")), 0.0);
  EXPECT_EQ(cause(), Cause::not_a_number);
  EXPECT_STREQ(supervisor_.fault().detail, "command motor");
}

TEST_F(SupervisorTest, NotANumberFromASensor) {
  sensors(0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(cause(), Cause::not_a_number);
}

TEST_F(SupervisorTest, StaysStoppedUntilReset) {
  command(std::nan(""));
  EXPECT_EQ(command(1.0), 0.0);
  supervisor_.stop(Cause::emergency_stop, "later");
  EXPECT_EQ(cause(), Cause::not_a_number);  // the first cause stays
  supervisor_.reset();
  EXPECT_EQ(command(1.0), 1.0);
}

TEST_F(SupervisorTest, CommandLimit) {
  command(3.0);
  command(6.0);
  command(9.0);
  EXPECT_EQ(command(10.0), 10.0);
  EXPECT_EQ(command(10.0001), 0.0);
  EXPECT_EQ(cause(), Cause::command_limit);
}

TEST_F(SupervisorTest, SlewLimit) {
  EXPECT_EQ(command(3.0), 3.0);
  EXPECT_EQ(command(-0.001), 0.0);
  EXPECT_EQ(cause(), Cause::slew_limit);
}

TEST_F(SupervisorTest, Workspace) {
  sensors(1000, 0, 0, 1, false);
  EXPECT_FALSE(supervisor_.stopped());
  sensors(1001, 0, 0, 1, false);
  EXPECT_EQ(cause(), Cause::workspace);
  EXPECT_EQ(command(1.0), 0.0);
}

// At v = 8 rad/s and 50 rad/s^2 the way to rest is 8^2 / 100 = 0.64 rad.
TEST_F(SupervisorTest, PredictedStoppingPosition) {
  double at = 0.0;
  while (!supervisor_.stopped() && at < 1000.0) {
    sensors(at);
    if (at > 80.0) {
      EXPECT_NEAR(supervisor_.rate(0), 8.0, 1e-9);
      EXPECT_NEAR(supervisor_.stopping_position(0), 1e-3 * at + 0.64, 1e-9);
    }
    at += 8.0;
  }
  EXPECT_EQ(cause(), Cause::stopping_position);
  EXPECT_NEAR(supervisor_.position(0), 0.368, 1e-9);  // the first multiple of 0.008 beyond 0.36
}

TEST_F(SupervisorTest, AwayFromTheLimitIsNoDanger) {
  for (double at = 900.0; at > 100.0; at -= 9.0) sensors(at);
  EXPECT_FALSE(supervisor_.stopped());
}

Plan without_workspace() {
  Plan plan = small_plan();
  plan.workspace.clear();
  return plan;
}

TEST_F(SupervisorTest, CountJump) {
  supervisor_ = Supervisor(without_workspace());
  sensors(0);
  sensors(21);  // 20 rad/s, and one count of quantisation
  EXPECT_FALSE(supervisor_.stopped());
  sensors(43);
  EXPECT_EQ(cause(), Cause::count_jump);
}

TEST_F(SupervisorTest, ALostSampleAllowsTwiceTheWay) {
  supervisor_ = Supervisor(without_workspace());
  sensors(0);
  sensors(41, 0, 0, 2);
  EXPECT_FALSE(supervisor_.stopped());
}

TEST_F(SupervisorTest, FrozenSensor) {
  sensors(0);
  for (int k = 0; k < 50; ++k) sensors(0);
  EXPECT_FALSE(supervisor_.stopped());
  sensors(0);
  EXPECT_EQ(cause(), Cause::frozen_sensor);
}

TEST_F(SupervisorTest, ARobotThatIsHeldMayRest) {
  for (int k = 0; k < 500; ++k) sensors(0, 0, 0, 1, false);
  EXPECT_FALSE(supervisor_.stopped());
}

TEST_F(SupervisorTest, ASwitchIsOpenOrClosed) {
  sensors(0, 0, 2);
  EXPECT_EQ(cause(), Cause::corrupt);
}

TEST_F(SupervisorTest, LostInSuccession) {
  supervisor_.packet(2);
  EXPECT_FALSE(supervisor_.stopped());
  supervisor_.packet(3);
  EXPECT_EQ(cause(), Cause::lost);
}

TEST_F(SupervisorTest, LostAmongAThousand) {
  for (int k = 0; k < 5; ++k) supervisor_.packet(1);
  for (int k = 0; k < 1000; ++k) supervisor_.packet(0);
  for (int k = 0; k < 5; ++k) supervisor_.packet(1);
  EXPECT_FALSE(supervisor_.stopped());
  supervisor_.packet(1);
  EXPECT_EQ(cause(), Cause::lost);
}

TEST_F(SupervisorTest, TwiceBehindAndCorrupt) {
  supervisor_.packet_twice();
  supervisor_.packet_behind();
  supervisor_.packet_corrupt();
  EXPECT_FALSE(supervisor_.stopped());
  Supervisor twice(small_plan()), behind(small_plan()), corrupt(small_plan());
  for (int k = 0; k < 2; ++k) {
    twice.packet_twice();
    behind.packet_behind();
    corrupt.packet_corrupt();
  }
  EXPECT_EQ(twice.fault().cause, Cause::duplicated);
  EXPECT_EQ(behind.fault().cause, Cause::reordered);
  EXPECT_EQ(corrupt.fault().cause, Cause::corrupt);
}

TEST_F(SupervisorTest, SilenceAndLateness) {
  supervisor_.silence(0.5);
  EXPECT_FALSE(supervisor_.stopped());
  supervisor_.silence(0.501);
  EXPECT_EQ(cause(), Cause::stale);
  supervisor_.reset();
  supervisor_.cycle(0.4);
  EXPECT_FALSE(supervisor_.stopped());
  supervisor_.cycle(0.401);
  EXPECT_EQ(cause(), Cause::late_cycle);
}

TEST_F(SupervisorTest, EveryCauseHasAName) {
  for (int k = 0; k < kCauses; ++k) EXPECT_STRNE(to_string(static_cast<Cause>(k)), "");
}

}  // namespace
}  // namespace plumbline::driver
