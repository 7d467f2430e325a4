#include "validation/cli/ranks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "simulator/trace/sha256.h"

namespace plumbline::cli {
namespace {

/// Like the signals' flag: a process has one, and MPI can be begun once.
std::unique_ptr<work::Workers>& holder() {
  static std::unique_ptr<work::Workers> the_workers = std::make_unique<work::Threads>(1);
  return the_workers;
}

/// "tune", "study step-down"; empty where the words begin with an option, or are none.
std::string command_of(const std::vector<std::string>& words) {
  if (words.size() < 2 || words[1].rfind('-', 0) == 0) {
    return "";
  }
  const bool is_study = words[1] == "study" && words.size() > 2 && words[2].rfind('-', 0) != 0;
  return is_study ? words[1] + " " + words[2] : words[1];
}

}  // namespace

std::string version_text() {
  const std::string mpi = work::mpi_name();
  return std::string(PLUMBLINE_VERSION) + (mpi.empty() ? " (no MPI)" : " (" + mpi + ")");
}

void start_ranks() {
  const char* times = std::getenv("PLUMBLINE_WORK_TIMES");
  holder() = work::start(times == nullptr ? "" : times);
  if (!workers().is_first()) {
    for (std::FILE* stream : {stdout, stderr}) {
      if (std::freopen("/dev/null", "w", stream) == nullptr) {
        std::fclose(stream);
      }
    }
  }
  if (workers().ranks() > 1) {
    workers().check_same("version of the program", PLUMBLINE_VERSION + sha256_of_file("/proc/self/exe"));
  }
}

work::Workers& workers() { return *holder(); }

void check_same_files(const std::vector<std::string>& files) {
  if (workers().ranks() == 1) {
    return;
  }
  std::string all;
  for (const std::string& file : files) {
    all += sha256_of_file(file);
  }
  workers().check_same("set of input files", all);
}

bool is_left_out(const std::vector<std::string>& words) {
  const std::vector<std::string> shared{"batch",           "certify", "diagnose",
                                        "study step-down", "tune",    "validate"};
  const std::string command = command_of(words);
  const int ranks = workers().ranks();
  if (ranks == 1 || std::find(shared.begin(), shared.end(), command) != shared.end()) {
    return false;
  }
  if (workers().is_first() && !command.empty()) {
    fmt::print(stderr, "plumbline: `{}` is no work for several ranks: one of {} does it\n", command, ranks);
  }
  return !workers().is_first();
}

}  // namespace plumbline::cli
