#include "tests/work/mpi_job.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

namespace plumbline::test {
namespace {

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

MpiJob::MpiJob(const std::vector<std::string>& words, const std::string& folder)
    : out_(folder + "/.job-out"), err_(folder + "/.job-err") {
  // All machines of Debian have the `mpirun` of the alternatives; Open MPI wants to be asked before it runs
  // as root.
  std::vector<std::string> all{"mpirun", "--allow-run-as-root", "--oversubscribe"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : all) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ == 0) {
    const int out = ::open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err = ::open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int in = ::open("/dev/null", O_RDONLY);
    if (::dup2(out, STDOUT_FILENO) >= 0 && ::dup2(err, STDERR_FILENO) >= 0 && ::dup2(in, STDIN_FILENO) >= 0 &&
        ::chdir(folder.c_str()) == 0) {
      ::execvp(argv.front(), argv.data());
    }
    ::_exit(127);
  }
}

MpiJob::~MpiJob() {
  if (is_running()) {
    ::kill(pid_, SIGTERM);
    wait();
  }
}

std::vector<pid_t> MpiJob::ranks() const {
  std::istringstream children(
      content("/proc/" + std::to_string(pid_) + "/task/" + std::to_string(pid_) + "/children"));
  return {std::istream_iterator<pid_t>(children), {}};
}

bool MpiJob::is_running() {
  ended_ = ended_ || ::waitpid(pid_, &raw_status_, WNOHANG) == pid_;
  return !ended_;
}

JobOutcome MpiJob::wait() {
  while (is_running()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const int status = WIFEXITED(raw_status_) ? WEXITSTATUS(raw_status_) : 128 + WTERMSIG(raw_status_);
  return {status, content(out_), content(err_)};
}

JobOutcome run_job(const std::vector<std::string>& words, const std::string& folder) {
  return MpiJob(words, folder).wait();
}

}  // namespace plumbline::test
