#include "simulator/render/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>

namespace plumbline::render {
namespace {

void close_if_open(int& descriptor) {
  if (descriptor >= 0) {
    close(descriptor);
    descriptor = -1;
  }
}

struct Ends {
  int ours, theirs;
};

/// A socket and not a pipe: writing to one that nobody reads can be told not to raise a signal.
Ends connected() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::runtime_error("cannot connect to another program");
  }
  return {ends[0], ends[1]};
}

int decoded(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

/// Between fork and exec: system calls only.
[[noreturn]] void become(char* const* arguments, int input, int status, int errors, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = open("/dev/null", O_WRONLY);
  if (getppid() == parent && nothing >= 0 && dup2(input, STDIN_FILENO) >= 0 &&
      dup2(nothing, STDOUT_FILENO) >= 0 && dup2(errors, STDERR_FILENO) >= 0) {
    fcntl(status, F_SETFD, 0);  // the only further one that stays open
    execvp(arguments[0], arguments);
  }
  _exit(127);
}

}  // namespace

bool program_exists(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((std::filesystem::path(folder) / name).c_str(), X_OK) == 0) {
      return true;
    }
  }
  return false;
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
  const Ends input = connected();
  const Ends status = connected();
  input_ = input.ours;
  status_ = status.ours;
  errors_ = memfd_create("errors", MFD_CLOEXEC);
  std::vector<std::string> words = arguments;
  for (std::string& word : words) {
    word = word == "{}" ? std::to_string(status.theirs) : word;
  }
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    become(pointers.data(), input.theirs, status.theirs, errors_, parent);
  }
  close(input.theirs);
  close(status.theirs);
  if (pid_ < 0) {
    close_if_open(input_);
    close_if_open(status_);
    close_if_open(errors_);
    throw std::runtime_error("cannot start " + arguments.front());
  }
}

ChildProcess::~ChildProcess() {
  close_if_open(input_);
  if (pid_ > 0) {
    kill(pid_, SIGTERM);
    for (int tenth = 0; tenth < 200 && waitpid(pid_, nullptr, WNOHANG) == 0; ++tenth) {
      usleep(10'000);
      if (tenth == 199) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
      }
    }
  }
  close_if_open(status_);
  close_if_open(errors_);
}

bool ChildProcess::write(const void* data, std::size_t size) {
  const char* rest = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = send(input_, rest, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) {
      continue;
    }
    if (sent <= 0) {
      return false;
    }
    rest += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

std::string ChildProcess::read_status(double seconds) {
  std::string line;
  pollfd wait{status_, POLLIN, 0};
  int left = static_cast<int>(1e3 * seconds);
  while (left > 0 && line.find('\n') == std::string::npos) {
    const int ready = poll(&wait, 1, std::min(left, 50));
    left -= 50;
    std::array<char, 64> buffer{};
    const ssize_t got = ready > 0 ? read(status_, buffer.data(), buffer.size()) : -1;
    if (got > 0) {
      line.append(buffer.data(), static_cast<std::size_t>(got));
    } else if (got == 0) {
      return "";
    }
  }
  return line.substr(0, line.find('\n'));
}

int ChildProcess::finish() {
  close_if_open(input_);
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return decoded(status);
}

std::string ChildProcess::last_words() const {
  const off_t size = lseek(errors_, 0, SEEK_END);
  std::string text(static_cast<std::size_t>(std::min<off_t>(size, 4000)), ' ');
  if (text.empty() || pread(errors_, text.data(), text.size(), size - static_cast<off_t>(text.size())) < 0) {
    return "";
  }
  std::string last;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    last = line.empty() ? last : line;
  }
  return last;
}

}  // namespace plumbline::render
