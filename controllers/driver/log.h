// Every cycle of a session, written by a thread of its own: files for people, and a trial for compare.
#pragma once

#include <atomic>
#include <cstdio>
#include <string>
#include <thread>

#include "controllers/driver/histogram.h"
#include "controllers/driver/plan.h"
#include "controllers/driver/ring.h"
#include "controllers/driver/supervisor.h"

namespace plumbline::driver {

/// What the driver is doing.
enum class State { waiting, idle, holding, running, stopped };
const char* to_string(State state) noexcept;

/// One cycle. Pointers are to as many numbers as the plan has.
struct Cycle {
  double sequence = 0.0;  ///< of the robot's packet, counted on where it wraps
  State state = State::waiting;
  Cause cause = Cause::none;
  std::uint32_t missing = 0;     ///< packets before this one that did not come
  std::int64_t arrival = 0;      ///< CLOCK_MONOTONIC, ns
  std::int64_t sent = 0;         ///< when the commands left
  std::uint64_t controller = 0;  ///< ns of the controller's step
  const double* channels = nullptr;
  const double* commands = nullptr;
  const double* log = nullptr;  ///< the controller's own
};

/// What happened beside the cycles.
struct Counts {
  std::uint64_t cycles = 0, steps = 0;
  std::uint64_t lost = 0, duplicated = 0, reordered = 0, corrupt = 0, foreign = 0, unsent = 0;
};

/// Made before the loop begins; push() and event() are for the loop.
///   cycles.csv   all cycles: state, cause, times, raw channels, commands, the controller's log
///   data.csv, trial.yaml   the first run from hand-over to its end: a trial that compare and diagnose read
///   events.txt   states and faults, with the loop's time
///   timing.json  histograms of wake-up, of sense to command and of the controller's step; counts of what was
///   lost
class Log {
 public:
  /// Makes the folder, which must be new or empty. Throws DriverError. `model`: path of the model file.
  Log(const std::string& folder, const Plan& plan, const std::string& model);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  void push(const Cycle& cycle) noexcept;
  /// A line for events.txt and the terminal; cut off after 190 characters.
  void event(double seconds, const char* text) noexcept;
  /// Ends the thread and writes trial.yaml and timing.json.
  /// `notes`: what the system did not allow.
  void finish(const std::string& notes, const Counts& counts, const Histogram& wake, const Histogram& answer,
              const Histogram& controller);
  std::uint64_t lost() const noexcept { return rows_.lost(); }

 private:
  static constexpr std::size_t kHead = 8;
  static constexpr std::size_t kEventWidth = 25;  // a time and 192 characters

  void write_all();
  bool drain();
  void write_head();
  void write_row(const double* row);
  void write_trial_row(const double* row);
  void write_trial_yaml() const;
  std::FILE* open(const std::string& name) const;

  std::string folder_, model_;
  Plan plan_;
  std::size_t channels_, commands_, log_;
  Ring rows_, events_;
  std::FILE* cycles_file_ = nullptr;
  std::FILE* data_file_ = nullptr;
  std::FILE* events_file_ = nullptr;
  bool trial_begun_ = false, trial_over_ = false;
  double first_sequence_ = 0.0, last_sequence_ = 0.0;
  std::uint64_t trial_rows_ = 0, trial_missing_ = 0;
  std::atomic<bool> over_{false};
  std::thread writer_;
};

}  // namespace plumbline::driver
