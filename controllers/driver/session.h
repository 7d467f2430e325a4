// From a robot's packet to the driver's answer: states, one cycle after the other.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "controllers/driver/controller_process.h"
#include "controllers/driver/histogram.h"
#include "controllers/driver/log.h"
#include "controllers/driver/packet.h"
#include "controllers/driver/plan.h"
#include "controllers/driver/supervisor.h"
#include "controllers/driver/transport.h"

namespace plumbline::driver {

/// What the operator asks for; given by another thread, taken by the loop.
enum class Request : std::uint32_t { none, arm, go, finish, stop, reset, quit };

enum class ClockSource { robot, timer };

struct SessionOptions {
  ClockSource clock = ClockSource::robot;
  std::uint32_t session = 1;  ///< number in every packet of this session
  double run_for = 0.0;       ///< s of running, then it finishes; 0: no end
};

/// States, and what leads from one to the other:
///
///     waiting --robot answers--> idle --arm--> holding --go--> running --finish--> idle
///     any of them --fault--> stopped --reset--> waiting
///
/// In waiting, idle and stopped all commands are 0 and no power is asked for. In holding each motor is kept
/// where it was when the power came. In running the controller commands. Everything that is sent has passed
/// the supervisor.
class Session {
 public:
  Session(const Plan& plan, Transport& transport, ControllerProcess& controller, Log* log,
          const SessionOptions& options);

  /// Until the operator quits. Between a packet and its answer nothing allocates and nothing waits, but for
  /// the controller, and for that at most as long as the plan allows.
  void run() noexcept;
  /// One turn of the loop, for tests.
  void turn() noexcept;

  void ask(Request request) noexcept { request_.store(request); }
  /// The certificate is not valid any more: arming is refused.
  void expire() noexcept { expired_.store(true); }

  State state() const noexcept { return state_.load(); }
  bool over() const noexcept { return over_.load(); }
  /// Faults so far, of the whole session.
  int faults() const noexcept { return faults_.load(); }
  const Supervisor& supervisor() const noexcept { return supervisor_; }
  const Counts& counts() const noexcept { return counts_; }
  const Histogram& wake() const noexcept { return wake_; }
  const Histogram& answer() const noexcept { return answer_; }
  const Histogram& controller_time() const noexcept { return controller_time_; }

 private:
  void take_request() noexcept;
  void arm() noexcept;
  void hand_over() noexcept;
  void enter(State state, const char* why) noexcept;
  void say(const char* text) noexcept;
  void note_fault() noexcept;

  void wait_for_robot() noexcept;
  void wait_for_tick() noexcept;
  bool receive() noexcept;
  bool accept(std::uint32_t& missing) noexcept;
  void cycle(std::uint32_t missing, std::int64_t arrival) noexcept;
  void watch_flags() noexcept;
  void make_commands() noexcept;
  void hold() noexcept;
  void step_controller() noexcept;
  void send() noexcept;
  double seconds() const noexcept;

  Plan plan_;
  Transport& transport_;
  ControllerProcess& controller_;
  Log* log_;
  SessionOptions options_;
  Supervisor supervisor_;
  std::uint32_t layout_;
  std::atomic<Request> request_{Request::none};
  std::atomic<bool> expired_{false}, over_{false};
  std::atomic<State> state_{State::waiting};
  std::atomic<int> faults_{0};

  Packet in_, out_;
  std::uint8_t buffer_[Packet::largest + 1] = {};
  bool heard_ = false;
  std::uint32_t sequence_ = 0;  // of the newest good packet
  double whole_sequence_ = 0.0;
  std::int64_t begun_ = 0, heard_at_ = 0, sent_at_ = 0, tick_ = 0, state_since_ = 0;
  bool ask_reset_ = false, tripped_ = false, power_was_on_ = false, hold_known_ = false, fault_noted_ = false;
  std::uint32_t reset_sequence_ = 0;  // of the first packet that asks the robot to forget its watchdog's trip
  std::uint64_t controller_ns_ = 0, steps_of_run_ = 0;
  std::vector<double> channels_, before_, commands_, controller_log_, hold_at_, inputs_, outputs_;
  Counts counts_;
  Histogram wake_, answer_, controller_time_;
};

}  // namespace plumbline::driver
