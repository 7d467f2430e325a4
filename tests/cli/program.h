// Runs the built `plumbline` in a folder and keeps what it said.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace plumbline::test {

struct Outcome {
  int status = -1;  ///< exit status; 128 + signal when a signal ended it
  std::string out, err;
};

/// Where standard error goes: a file, or a terminal, on which long work shows how far it is.
enum class Errors { file, terminal };

/// A running program. Its output goes to files in a folder of its own, removed in the end.
class Process {
 public:
  Process(const std::vector<std::string>& arguments, const std::string& working_folder,
          Errors errors = Errors::file);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits until it catches SIGINT itself: before that, Ctrl-C would just end it.
  void wait_until_ready() const;
  /// Waits until the terminal has shown this text. False when the program ends before, or after a minute.
  bool wait_for_shown(const std::string& text);
  void interrupt() const;  ///< as Ctrl-C does
  void kill() const;       ///< SIGKILL: it can do nothing about it
  /// Seconds of processor that it has used, all its threads; what else runs on the machine does not count.
  double processor_seconds() const;
  bool is_running();
  Outcome wait();

 private:
  void start(const std::vector<std::string>& arguments, const std::string& working_folder);
  void read_terminal();

  std::string folder_, shown_;
  int terminal_ = -1, terminal_of_child_ = -1;
  pid_t pid_ = -1;
  bool ended_ = false;
  int raw_status_ = 0;
  double last_processor_seconds_ = 0.0;
};

Outcome run(const std::vector<std::string>& arguments, const std::string& working_folder);

}  // namespace plumbline::test
