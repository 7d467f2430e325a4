// A program that runs beside this one and never outlives it.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace plumbline::render {

/// True when the program is found on the PATH.
bool program_exists(const std::string& name);

/// Started with its standard input connected to write(); its standard output is dropped, its errors are kept
/// in memory for last_words(). It has a process group of its own, so that Ctrl-C on the terminal reaches only
/// us, and the kernel ends it should we die without a destructor.
class ChildProcess {
 public:
  /// `pass_status_pipe`: "{}" in an argument becomes the number of a file descriptor that read_status()
  /// reads. Throws std::runtime_error when nothing can be started.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  /// Asks it to end, kills it after two seconds, and waits until it is gone.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  /// False when it does not listen any more.
  bool write(const void* data, std::size_t size);
  /// The first line that it writes to the status descriptor; empty when it ends or after `seconds`.
  std::string read_status(double seconds);
  /// Closes its input and waits; its exit status, 128 + signal.
  int finish();
  /// The last line on its standard error.
  std::string last_words() const;

 private:
  int input_ = -1, status_ = -1, errors_ = -1;
  pid_t pid_ = -1;
};

}  // namespace plumbline::render
