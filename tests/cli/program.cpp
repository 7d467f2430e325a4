#include "tests/cli/program.h"

#include <fcntl.h>
#include <pty.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace plumbline::test {
namespace {

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// In the child: only calls that are safe between fork and exec.
void redirect(const char* file, int descriptor) {
  const int opened = ::open(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || ::dup2(opened, descriptor) < 0) {
    ::_exit(126);
  }
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const std::string& working_folder,
                 Errors errors) {
  std::string pattern = (std::filesystem::temp_directory_path() / "plumbline-run-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("no temporary folder");
  }
  folder_ = pattern;
  if (errors == Errors::terminal) {
    if (::openpty(&terminal_, &terminal_of_child_, nullptr, nullptr, nullptr) != 0) {
      throw std::runtime_error("no terminal");
    }
    ::fcntl(terminal_, F_SETFL, O_NONBLOCK);
  }
  start(arguments, working_folder);
}

void Process::start(const std::vector<std::string>& arguments, const std::string& working_folder) {
  const std::string program = PLUMBLINE_PROGRAM;
  const std::string out = folder_ + "/out";
  const std::string err = folder_ + "/err";
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ == 0) {
    redirect(out.c_str(), STDOUT_FILENO);
    terminal_ >= 0 ? void(::dup2(terminal_of_child_, STDERR_FILENO)) : redirect(err.c_str(), STDERR_FILENO);
    if (::chdir(working_folder.c_str()) == 0) {
      ::execv(program.c_str(), argv.data());
    }
    ::_exit(127);
  }
}

Process::~Process() {
  if (!ended_ && pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &raw_status_, 0);
  }
  if (terminal_ >= 0) {
    ::close(terminal_);
    ::close(terminal_of_child_);
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void Process::read_terminal() {
  std::array<char, 4096> buffer{};
  for (ssize_t n = 1; terminal_ >= 0 && n > 0;) {
    n = ::read(terminal_, buffer.data(), buffer.size());
    shown_.append(buffer.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
  }
}

bool Process::wait_for_shown(const std::string& text) {
  for (int tries = 0; tries < 30000; ++tries) {
    read_terminal();
    if (shown_.find(text) != std::string::npos) {
      return true;
    }
    if (!is_running()) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

void Process::wait_until_ready() const {
  const std::string status = "/proc/" + std::to_string(pid_) + "/status";
  for (int tries = 0; tries < 2000; ++tries) {
    std::istringstream lines(content(status));
    for (std::string line; std::getline(lines, line);) {
      // "SigCgt:" and the signals that are caught, as bits in hexadecimal; signal n is bit n - 1
      const bool caught = line.rfind("SigCgt:", 0) == 0 &&
                          (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1U) != 0U;
      if (caught) {
        return;
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void Process::interrupt() const { ::kill(pid_, SIGINT); }

void Process::kill() const { ::kill(pid_, SIGKILL); }

double Process::processor_seconds() const {
  clockid_t clock{};
  timespec used{};
  if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &used) != 0) {
    return last_processor_seconds_;  // it has ended
  }
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

bool Process::is_running() {
  if (!ended_) {
    rusage used{};
    ended_ = ::wait4(pid_, &raw_status_, WNOHANG, &used) == pid_;
    if (ended_) {
      for (const timeval& part : {used.ru_utime, used.ru_stime}) {
        last_processor_seconds_ +=
            static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
      }
    }
  }
  return !ended_;
}

Outcome Process::wait() {
  while (is_running()) {
    read_terminal();  // or the program would wait until somebody does
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  read_terminal();
  Outcome outcome;
  outcome.status = WIFEXITED(raw_status_) ? WEXITSTATUS(raw_status_) : 128 + WTERMSIG(raw_status_);
  outcome.out = content(folder_ + "/out");
  outcome.err = terminal_ >= 0 ? shown_ : content(folder_ + "/err");
  return outcome;
}

Outcome run(const std::vector<std::string>& arguments, const std::string& working_folder) {
  return Process(arguments, working_folder).wait();
}

}  // namespace plumbline::test
