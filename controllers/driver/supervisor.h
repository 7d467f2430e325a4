// Watches sensors, packets, commands and times, and says when the robot must be stopped. Pure: no clock, no
// operating system, nothing of the controller.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "controllers/driver/cause.h"
#include "controllers/driver/plan.h"

namespace plumbline::driver {

/// The first thing that went wrong; what comes after it does not replace it.
struct Fault {
  Cause cause = Cause::none;
  char detail[160] = "";  ///< which channel, what was found, what was allowed
};

/// How many of the newest 1000 events were bad.
class RecentCount {
 public:
  void add(bool bad) noexcept;
  int bad() const noexcept { return bad_; }
  void clear() noexcept { *this = RecentCount(); }

 private:
  std::array<std::uint64_t, 16> bits_{};
  int next_ = 0, bad_ = 0;
};

/// Give it what happened in a cycle, in any order, and send what command() has left of the commands. Once
/// anything was wrong every command is 0 until reset(). After construction nothing allocates, blocks or
/// throws.
class Supervisor {
 public:
  explicit Supervisor(const Plan& plan);

  /// Latches; the first cause stays.
  void stop(Cause cause, const char* detail) noexcept;
  bool stopped() const noexcept { return fault_.cause != Cause::none; }
  const Fault& fault() const noexcept { return fault_; }
  /// Forgets the fault and the history. Whether the cause is over shows with the next cycle.
  void reset() noexcept;

  /// A packet that was good, `missing` of its predecessors having not come.
  void packet(std::uint32_t missing) noexcept;
  void packet_twice() noexcept;
  void packet_behind() noexcept;
  void packet_corrupt() noexcept;
  /// No good packet for `seconds`.
  void silence(double seconds) noexcept;

  /// The channels' newest values (counts as they are), `periods` after the ones before. `moving`: the
  /// controller runs, so that a sensor that rests for long is broken.
  void sensors(const double* channels, std::uint32_t periods, bool moving) noexcept;
  /// Holds each command to its limits, in place. Sets all of them to 0 where anything is or was wrong.
  void command(double* commands) noexcept;
  /// The commands left `seconds` after their sample had come.
  void cycle(double seconds) noexcept;

  /// Of a reach, in its unit, for messages and tests: where it is, its rate, and where it would come to rest.
  double position(std::size_t reach) const noexcept { return reaches_[reach].position; }
  double rate(std::size_t reach) const noexcept { return reaches_[reach].rate; }
  double stopping_position(std::size_t reach) const noexcept { return reaches_[reach].stopping; }

 private:
  /// A rate is taken over so many samples: one count more or less then weighs little.
  static constexpr std::size_t kSpan = 8;
  struct ReachState {
    double position = 0.0, rate = 0.0, stopping = 0.0;
    std::array<double, kSpan + 1> positions{};  // newest first
    std::array<double, kSpan + 1> times{};      // in periods
    std::size_t known = 0;
  };
  void check_channels(const double* channels, std::uint32_t periods, bool moving) noexcept;
  void check_reach(std::size_t index, const double* channels) noexcept;
  __attribute__((format(printf, 3, 4))) void stop_with(Cause cause, const char* format, ...) noexcept;

  Plan plan_;
  Fault fault_;
  RecentCount lost_, duplicated_, reordered_, corrupt_, late_;
  std::vector<double> last_channels_, last_commands_;
  std::vector<double> rested_;  // periods without a change
  bool channels_known_ = false;
  double periods_ = 0.0;
  std::vector<ReachState> reaches_;
};

}  // namespace plumbline::driver
