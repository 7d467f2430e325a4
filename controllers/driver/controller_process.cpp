#include "controllers/driver/controller_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "controllers/driver/futex.h"
#include "controllers/driver/transport.h"

extern char** environ;

namespace plumbline::driver {
namespace {

constexpr std::int64_t kStartTime = 5000000000;  // ns for loading and making
constexpr std::int64_t kSecond = 1000000000;
constexpr int kMemoryFile = 3, kLibraryFile = 4;  // in the controller's process

void copy_name(char (&to)[64], const std::string& from) {
  if (from.size() >= sizeof to) throw DriverError("\"" + from + "\": a name of more than 63 characters");
  std::memcpy(to, from.c_str(), from.size() + 1);
}

int memory_file(const char* name) {
  const int file = memfd_create(name, MFD_CLOEXEC);
  if (file < 0) throw DriverError(std::string("memfd_create: ") + std::strerror(errno));
  return file;
}

void write_all(int file, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = write(file, bytes.data() + done, bytes.size() - done);
    if (n <= 0)
      throw DriverError(std::string("memory for the controller's library: ") + std::strerror(errno));
    done += static_cast<std::size_t>(n);
  }
}

extern "C" void nothing(int /*signal*/) {}

}  // namespace

ControllerProcess::ControllerProcess(const std::string& program, const Plan& plan,
                                     const std::string& library_bytes, const Schedule& schedule)
    : program_(program), plan_(plan), schedule_(schedule) {
  if (plan.inputs.size() > Mailbox::most || plan.outputs.size() > Mailbox::most ||
      plan.log.size() > Mailbox::most || plan.constants.size() > Mailbox::most_constants) {
    throw DriverError("the controller has more than 128 ports of one kind, or more than 1024 constants");
  }
  // A controller that ends interrupts the wait for its answer.
  struct sigaction action {};
  action.sa_handler = nothing;
  action.sa_flags = SA_NOCLDSTOP;
  sigaction(SIGCHLD, &action, nullptr);
  library_ = memory_file("controller");
  write_all(library_, library_bytes);
  memory_ = memory_file("mailbox");
  if (ftruncate(memory_, sizeof(Mailbox)) != 0) throw DriverError("memory for the controller");
  void* memory =
      mmap(nullptr, sizeof(Mailbox), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, memory_, 0);
  if (memory == MAP_FAILED) throw DriverError("memory for the controller");
  mailbox_ = static_cast<Mailbox*>(memory);
  try {
    start();
  } catch (...) {
    stop();
    munmap(mailbox_, sizeof(Mailbox));
    close(library_);
    close(memory_);
    throw;
  }
}

ControllerProcess::~ControllerProcess() {
  ask(Mailbox::end, monotonic_now() + kSecond / 10);
  stop();
  munmap(mailbox_, sizeof(Mailbox));
  close(library_);
  close(memory_);
}

void ControllerProcess::start() {
  new (mailbox_) Mailbox{};
  number_ = 0;
  Mailbox& box = *mailbox_;
  box.input_count = static_cast<std::uint32_t>(plan_.inputs.size());
  box.output_count = static_cast<std::uint32_t>(plan_.outputs.size());
  box.log_count = static_cast<std::uint32_t>(plan_.log.size());
  box.constant_count = static_cast<std::uint32_t>(plan_.constants.size());
  box.period = plan_.period;
  std::copy(plan_.constants.begin(), plan_.constants.end(), box.constants);
  for (std::size_t k = 0; k < plan_.inputs.size(); ++k) {
    copy_name(box.names[k], plan_.inputs[k].port);
    box.scales[k] = plan_.inputs[k].scale;
  }
  for (std::size_t k = 0; k < plan_.outputs.size(); ++k) {
    copy_name(box.names[Mailbox::most + k], plan_.outputs[k].port);
  }
  for (std::size_t k = 0; k < plan_.log.size(); ++k)
    copy_name(box.names[2 * Mailbox::most + k], plan_.log[k]);
  for (std::size_t k = 0; k < plan_.constants.size(); ++k) {
    copy_name(box.names[3 * Mailbox::most + k], plan_.constant_names[k]);
  }
  copy_name(box.name, plan_.controller);
  copy_name(box.version, plan_.controller_version);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, memory_, kMemoryFile + 10);
  posix_spawn_file_actions_adddup2(&files, library_, kLibraryFile + 10);
  posix_spawn_file_actions_adddup2(&files, kMemoryFile + 10, kMemoryFile);
  posix_spawn_file_actions_adddup2(&files, kLibraryFile + 10, kLibraryFile);
  posix_spawn_file_actions_addclose(&files, kMemoryFile + 10);
  posix_spawn_file_actions_addclose(&files, kLibraryFile + 10);
  std::string words[] = {program_,
                         kControllerArgument,
                         std::to_string(getpid()),
                         std::to_string(schedule_.priority),
                         std::to_string(schedule_.core),
                         schedule_.lock_memory ? "lock" : "free"};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                       words[4].data(), words[5].data(), nullptr};
  const int code = posix_spawn(&pid_, program_.c_str(), &files, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  if (code != 0) {
    pid_ = -1;
    throw DriverError(program_ + ": cannot be started: " + std::strerror(code));
  }
  if (!ask(Mailbox::reset, monotonic_now() + kStartTime)) {
    throw DriverError(plan_.library + ": the controller's process ended or hung while it was loaded");
  }
  if (box.result != 0) {
    box.message[sizeof box.message - 1] = '\0';
    throw DriverError(plan_.library + ": " + box.message);
  }
}

void ControllerProcess::stop() noexcept {
  if (pid_ < 0) return;
  kill(pid_, SIGKILL);
  while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
}

void ControllerProcess::restart() {
  stop();
  start();
}

bool ControllerProcess::ended() noexcept {
  if (pid_ < 0) return true;
  siginfo_t info{};
  // Left to be waited for: stop() does that.
  return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         info.si_pid == pid_;
}

bool ControllerProcess::ask(Mailbox::Task task, std::int64_t deadline) noexcept {
  Mailbox& box = *mailbox_;
  box.task = task;
  ++number_;
  box.request.store(number_, std::memory_order_release);
  futex_wake(box.request);
  while (true) {
    const std::uint32_t seen = box.answer.load(std::memory_order_acquire);
    if (seen == number_) return true;
    if (monotonic_now() >= deadline || ended()) return false;
    futex_wait(box.answer, seen, deadline);
  }
}

bool ControllerProcess::reset() noexcept {
  return ask(Mailbox::reset, monotonic_now() + kSecond) && mailbox_->result == 0;
}

Answer ControllerProcess::step(const double* inputs, double* outputs, double* log,
                               std::int64_t deadline) noexcept {
  Mailbox& box = *mailbox_;
  std::copy(inputs, inputs + plan_.inputs.size(), box.inputs);
  if (!ask(Mailbox::step, deadline)) return ended() ? Answer::crashed : Answer::overrun;
  if (log != nullptr) std::copy(box.log, box.log + plan_.log.size(), log);
  if (box.result != 0) {
    std::memcpy(message_, box.message, sizeof message_);
    message_[sizeof message_ - 1] = '\0';
    return Answer::gave_up;
  }
  std::copy(box.outputs, box.outputs + plan_.outputs.size(), outputs);
  return Answer::done;
}

}  // namespace plumbline::driver
