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

bool is_left_out(const std::vector<std::string>& words) {
  const std::vector<std::string> shared{"batch", "certify", "diagnose"};
  const int ranks = workers().ranks();
  const bool is_shared =
      words.size() > 1 && std::find(shared.begin(), shared.end(), words[1]) != shared.end();
  if (ranks == 1 || is_shared) {
    return false;
  }
  if (workers().is_first() && words.size() > 1 && words[1].rfind('-', 0) != 0) {
    fmt::print(stderr, "plumbline: `{}` is no work for several ranks: one of {} does it\n", words[1], ranks);
  }
  return !workers().is_first();
}

}  // namespace plumbline::cli
