// The driver's loop against a robot that lives in the test: states, faults, and zero torque within one cycle.
#include "controllers/driver/session.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <deque>
#include <fstream>

#include "controllers/driver/signature.h"
#include "tests/driver/small_plan.h"

namespace plumbline::driver {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Both directions in memory; the test is the robot.
class Wire : public Transport {
 public:
  bool send(const std::uint8_t* data, std::size_t size) noexcept override {
    Packet packet;
    EXPECT_TRUE(decode(data, size, packet));
    sent_.push_back(packet);
    return true;
  }
  std::size_t receive(std::uint8_t* buffer, std::size_t size) noexcept override {
    if (waiting_.empty()) return 0;
    const Bytes bytes = waiting_.front();
    waiting_.pop_front();
    const std::size_t n = std::min(size, bytes.size());
    std::copy_n(bytes.begin(), n, buffer);
    return n;
  }
  std::int64_t arrived() const noexcept override { return monotonic_now() - late_; }
  bool wait(std::int64_t deadline) noexcept override {
    while (waiting_.empty() && monotonic_now() < deadline) usleep(100);
    return !waiting_.empty();
  }
  std::vector<Packet> sent_;
  std::deque<Bytes> waiting_;
  std::int64_t late_ = 0;
};

class SessionTest : public ::testing::Test {
 protected:
  void begin(int fault = 0, double at = 0.0) {
    plan_ = small_plan();
    plan_.constants = {static_cast<double>(fault), at};
    controller_ =
        std::make_unique<ControllerProcess>(DRIVE_PROGRAM, plan_, read_bytes(STUB_CONTROLLER), Schedule());
    session_ = std::make_unique<Session>(plan_, wire_, *controller_, nullptr, SessionOptions());
  }

  Packet packet() {
    Packet packet;
    packet.kind = Packet::sensors;
    packet.session = 1;
    packet.sequence = ++sequence_;
    packet.layout = layout_of(plan_.channel_names(), plan_.command_names());
    packet.echo = wire_.sent_.empty() ? 0 : wire_.sent_.back().sequence;
    packet.flags = flags_ | (power_ ? robot_flag::power : 0U);
    packet.count = 3;
    // It swings, so that no sensor rests.
    packet.set_whole(0, std::lround(100.0 * std::sin(0.05 * static_cast<double>(sequence_))));
    packet.set_real(1, 0.0);
    packet.set_whole(2, 0);
    return packet;
  }
  void put(const Packet& packet) {
    std::uint8_t bytes[Packet::largest];
    const std::size_t size = encode(packet, bytes);
    wire_.waiting_.emplace_back(bytes, bytes + size);
  }
  /// One sample of the robot; returns what the driver answered.
  Packet sample() { return sample(packet()); }
  Packet sample(const Packet& sent) {
    put(sent);
    session_->turn();
    const Packet answer = wire_.sent_.back();
    power_ = (answer.flags & driver_flag::power) != 0U;
    return answer;
  }
  void request(Request request) {
    session_->ask(request);
    sample();
  }
  void run_to(State state) {
    sample();
    if (state == State::idle) return;
    request(Request::arm);
    sample();
    sample();
    if (state == State::holding) return;
    request(Request::go);
    for (int k = 0; k < 20; ++k) sample();
  }
  void expect_stopped(Cause cause, const Packet& answer) {
    EXPECT_EQ(session_->state(), State::stopped);
    EXPECT_STREQ(to_string(session_->supervisor().fault().cause), to_string(cause));
    EXPECT_EQ(answer.real(0), 0.0);
    EXPECT_EQ(answer.flags & driver_flag::power, 0U);
    // It stays so.
    for (int k = 0; k < 5; ++k) {
      const Packet later = sample();
      EXPECT_EQ(later.real(0), 0.0);
      EXPECT_EQ(later.flags & driver_flag::power, 0U);
    }
    session_->ask(Request::arm);
    sample();
    EXPECT_EQ(session_->state(), State::stopped);
  }

  Plan plan_;
  Wire wire_;
  std::unique_ptr<ControllerProcess> controller_;
  std::unique_ptr<Session> session_;
  std::uint32_t sequence_ = 0, flags_ = 0;
  bool power_ = false;
};

TEST_F(SessionTest, NeverStartsWithTorque) {
  begin();
  EXPECT_EQ(session_->state(), State::waiting);
  for (int k = 0; k < 10; ++k) {
    const Packet answer = sample();
    EXPECT_EQ(answer.flags, 0U);
    EXPECT_EQ(answer.real(0), 0.0);
  }
  EXPECT_EQ(session_->state(), State::idle);
  request(Request::go);  // not without being armed
  EXPECT_EQ(session_->state(), State::idle);
}

TEST_F(SessionTest, HoldsThenHandsOver) {
  begin();
  run_to(State::idle);
  session_->ask(Request::arm);
  const Packet asks = sample();
  EXPECT_EQ(asks.flags, driver_flag::power);
  EXPECT_EQ(asks.real(0), 0.0);  // no torque before the power is on
  const Packet first = sample();
  EXPECT_EQ(first.real(0), 0.0);  // where it is, it is held
  EXPECT_NE(sample().real(0), 0.0);
  session_->ask(Request::go);
  sample();
  EXPECT_EQ(session_->state(), State::running);
  EXPECT_EQ(wire_.sent_.back().flags, driver_flag::power | driver_flag::running);
  request(Request::finish);
  EXPECT_EQ(session_->state(), State::idle);
  EXPECT_EQ(wire_.sent_.back().real(0), 0.0);
  EXPECT_EQ(session_->faults(), 0);
}

TEST_F(SessionTest, HandsOverOnlyFromThePosture) {
  begin();
  plan_.channels[0].speed = kNone;
  plan_.commands[0].slew = kNone;
  plan_.workspace.clear();
  session_ = std::make_unique<Session>(plan_, wire_, *controller_, nullptr, SessionOptions());
  run_to(State::holding);
  Packet far = packet();
  far.set_whole(0, 600);
  sample(far);
  session_->ask(Request::go);
  session_->turn();
  EXPECT_EQ(session_->state(), State::holding);
}

TEST_F(SessionTest, TheControllersCommandsArrive) {
  begin();
  run_to(State::running);
  const Packet sent = packet();
  const double before = 1e-3 * std::round(100.0 * std::sin(0.05 * static_cast<double>(sequence_ - 1)));
  const double at = 1e-3 * static_cast<double>(sent.whole(0));
  EXPECT_NEAR(sample(sent).real(0), -2.0 * at - 20.0 * (at - before), 1e-12);
}

struct ControllerFault {
  int fault;
  Cause cause;
};
class ControllerFaults : public SessionTest, public ::testing::WithParamInterface<ControllerFault> {};

TEST_P(ControllerFaults, StopInTheSameCycle) {
  begin(GetParam().fault, 30.0);
  run_to(State::running);
  Packet answer;
  for (int k = 0; k < 40 && session_->state() == State::running; ++k) answer = sample();
  EXPECT_EQ(session_->counts().steps, 31U);
  expect_stopped(GetParam().cause, answer);
}

INSTANTIATE_TEST_SUITE_P(All, ControllerFaults,
                         ::testing::Values(ControllerFault{1, Cause::not_a_number},
                                           ControllerFault{2, Cause::command_limit},
                                           ControllerFault{3, Cause::slew_limit},
                                           ControllerFault{4, Cause::controller_gave_up},
                                           ControllerFault{5, Cause::controller_overrun},
                                           ControllerFault{6, Cause::controller_crash},
                                           ControllerFault{7, Cause::controller_crash}));

TEST_F(SessionTest, ACrashedControllerIsReplacedAfterAReset) {
  begin(6, 30.0);
  run_to(State::running);
  while (session_->state() == State::running) sample();
  request(Request::reset);
  sample();
  EXPECT_EQ(session_->state(), State::idle);
  run_to(State::running);
  EXPECT_EQ(session_->state(), State::running);
}

TEST_F(SessionTest, EmergencyStopFromAllSides) {
  begin();
  run_to(State::running);
  session_->ask(Request::stop);
  expect_stopped(Cause::emergency_stop, sample());
  request(Request::reset);
  run_to(State::running);
  flags_ = robot_flag::emergency_stop;
  expect_stopped(Cause::emergency_stop, sample());
  flags_ = 0;
}

TEST_F(SessionTest, PowerThatIsCut) {
  begin();
  run_to(State::running);
  Packet off = packet();
  off.flags = robot_flag::tripped;
  expect_stopped(Cause::power_cut, sample(off));
}

TEST_F(SessionTest, PacketsThatGoWrong) {
  begin();
  run_to(State::running);
  sequence_ += 2;
  sample();
  EXPECT_EQ(session_->state(), State::running);
  sequence_ += 3;
  expect_stopped(Cause::lost, sample());

  request(Request::reset);
  run_to(State::running);
  const Packet again = packet();
  sample(again);
  sample(again);
  EXPECT_EQ(session_->state(), State::running);
  expect_stopped(Cause::duplicated, sample(again));

  request(Request::reset);
  run_to(State::running);
  Packet behind = packet();
  behind.sequence -= 5;
  sample(behind);
  behind.sequence += 1;
  expect_stopped(Cause::reordered, sample(behind));

  request(Request::reset);
  run_to(State::running);
  for (int k = 0; k < 2; ++k) {
    put(packet());
    wire_.waiting_.back()[45] ^= 1;
    session_->turn();
  }
  expect_stopped(Cause::corrupt, wire_.sent_.back());
}

TEST_F(SessionTest, OtherLayoutAndOtherSession) {
  begin();
  run_to(State::running);
  Packet foreign = packet();
  foreign.session = 99;
  foreign.set_whole(0, 100000);
  put(foreign);
  sample();
  EXPECT_EQ(session_->state(), State::running);
  EXPECT_EQ(session_->counts().foreign, 1U);
  Packet other = packet();
  other.layout = 1;
  expect_stopped(Cause::wrong_layout, sample(other));
}

TEST_F(SessionTest, SilenceOfTheRobot) {
  begin();
  run_to(State::running);
  while (session_->state() == State::running) session_->turn();
  expect_stopped(Cause::stale, wire_.sent_.back());
}

TEST_F(SessionTest, ADriverThatSleptIsLate) {
  begin();
  run_to(State::running);
  wire_.late_ = 450000000;
  expect_stopped(Cause::late_cycle, sample());
}

TEST_F(SessionTest, AnExpiredCertificateDoesNotArm) {
  begin();
  run_to(State::idle);
  session_->expire();
  session_->ask(Request::arm);
  expect_stopped(Cause::expired_certificate, sample());
}

TEST_F(SessionTest, AfterTheWatchdogOnlyAResetArms) {
  begin();
  flags_ = robot_flag::tripped;
  run_to(State::idle);
  request(Request::arm);
  EXPECT_EQ(session_->state(), State::idle);
  session_->ask(Request::reset);
  EXPECT_NE(sample().flags & driver_flag::reset, 0U);
  flags_ = 0;
  EXPECT_EQ(sample().flags & driver_flag::reset, 0U);
  request(Request::arm);
  EXPECT_EQ(session_->state(), State::holding);
}

// A robot that has fallen is outside its workspace, and jumps when it is put back: neither is a fault while
// nothing is under power and the robot has not taken the reset. It is not armed before that.
TEST_F(SessionTest, AFallenRobotIsPutBackByAReset) {
  begin();
  run_to(State::running);
  Packet fallen = packet();
  fallen.set_whole(0, 100000);
  sample(fallen);
  ASSERT_EQ(session_->state(), State::stopped);
  session_->ask(Request::reset);
  const std::uint32_t before = wire_.sent_.back().sequence;
  for (int k = 0; k < 3; ++k) {
    fallen = packet();
    fallen.set_whole(0, 100000);
    fallen.echo = before;
    EXPECT_NE(sample(fallen).flags & driver_flag::reset, 0U);
  }
  EXPECT_EQ(session_->state(), State::idle);
  session_->ask(Request::arm);
  fallen = packet();
  fallen.set_whole(0, 100000);
  fallen.echo = before;
  sample(fallen);
  EXPECT_EQ(session_->state(), State::idle);
  EXPECT_EQ(sample().flags & driver_flag::reset, 0U);  // back, and it has heard
  sample();
  EXPECT_FALSE(session_->supervisor().stopped());
  request(Request::arm);
  EXPECT_EQ(session_->state(), State::holding);
}

TEST_F(SessionTest, AControllerWithOtherPortsIsRefused) {
  Plan plan = small_plan();
  plan.inputs[1].port = "tilted";
  const std::string bytes = read_bytes(STUB_CONTROLLER);
  EXPECT_THROW(ControllerProcess(DRIVE_PROGRAM, plan, bytes, Schedule()), DriverError);
  plan = small_plan();
  plan.constants[0] = -1.0;
  EXPECT_THROW(ControllerProcess(DRIVE_PROGRAM, plan, bytes, Schedule()), DriverError);
  EXPECT_THROW(ControllerProcess(DRIVE_PROGRAM, small_plan(), "no library", Schedule()), DriverError);
}

}  // namespace
}  // namespace plumbline::driver
