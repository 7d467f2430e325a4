// The controller in a process of its own: what it does wrong cannot reach the supervisor's memory.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "controllers/driver/packet.h"
#include "controllers/driver/plan.h"

namespace plumbline::driver {

/// Memory that driver and controller share. The driver writes a request and waits, for a bounded time, until
/// the answer has the same number.
struct Mailbox {
  static constexpr std::size_t most = Packet::most_values;
  static constexpr std::size_t most_constants = 1024;
  enum Task : std::uint32_t { step, reset, end };
  std::atomic<std::uint32_t> request, answer;  // futexes
  std::uint32_t task;
  std::int32_t result;        // of step(), or not 0 where the controller could not be made
  std::uint64_t nanoseconds;  // that step() took
  double inputs[most], outputs[most], log[most];
  // Set before the first answer, from the library and by the driver.
  std::uint32_t input_count, output_count, log_count, constant_count;
  double period, constants[most_constants], scales[most];
  char names[3 * most + most_constants][64];  // wanted: inputs, outputs, log, constants
  char name[64], version[64];
  char message[256];
};

/// How the controller answered.
enum class Answer { done, gave_up, overrun, crashed };

/// Threads that the controller's process may use: real-time priority (0: none) and core (-1: any).
struct Schedule {
  int priority = 0;
  int core = -1;
  bool lock_memory = false;
};

class ControllerProcess {
 public:
  /// Starts `program` (the driver's own file) with the hidden argument that runs controller_main(). The
  /// library's bytes are those of `library_bytes`, which were checked: no file is read again. Throws
  /// DriverError when the library cannot be loaded, has other ports or constants than the plan, or refuses
  /// its constants.
  ControllerProcess(const std::string& program, const Plan& plan, const std::string& library_bytes,
                    const Schedule& schedule);
  ~ControllerProcess();
  ControllerProcess(const ControllerProcess&) = delete;
  ControllerProcess& operator=(const ControllerProcess&) = delete;

  /// As after its start; a process that has ended or hangs is replaced. Not for the control loop.
  void restart();

  /// reset() of the controller; false when it does not answer within a second.
  bool reset() noexcept;
  /// One sample, in the order of the plan's inputs and outputs. Waits until CLOCK_MONOTONIC shows `deadline`
  /// at most. Outputs are written only when the answer is `done`.
  Answer step(const double* inputs, double* outputs, double* log, std::int64_t deadline) noexcept;
  std::uint64_t nanoseconds() const noexcept { return mailbox_->nanoseconds; }  ///< of the last step
  /// In words, why it gave up.
  const char* message() const noexcept { return message_; }

 private:
  void start();
  void stop() noexcept;
  bool ended() noexcept;
  bool ask(Mailbox::Task task, std::int64_t deadline) noexcept;

  std::string program_;
  Plan plan_;
  Schedule schedule_;
  int library_ = -1, memory_ = -1;
  Mailbox* mailbox_ = nullptr;
  pid_t pid_ = -1;
  std::uint32_t number_ = 0;
  char message_[256] = "";
};

/// The name of the hidden argument.
constexpr const char* kControllerArgument = "--controller-process";

/// The controller's side: `arguments` are those behind the hidden one. Returns the process's exit status.
int controller_main(int argc, char** argv);

}  // namespace plumbline::driver
