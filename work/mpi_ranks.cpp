// The ranks of an MPI job.
#include <mpi.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "work/mpi_run.h"

namespace plumbline::work {
namespace {

using Clock = std::chrono::steady_clock;

class MpiRanks : public Workers {
 public:
  explicit MpiRanks(const std::string& times) : rank_(begin()), times_(rank_ == 0 ? times : "") {
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }

  int ranks() const override { return is_within_task() ? 1 : size_; }
  bool is_first() const override { return rank_ == 0; }

  Results run(const std::vector<Task>& tasks, const Watch& watch) override {
    if (is_within_task()) {
      return Threads(1).run(tasks, watch);
    }
    if (rank_ != 0) {
      return follow(tasks, watch);
    }
    times_.next_run();
    return lead(tasks, watch, size_, times_);
  }

  void check_same(const std::string& what, const std::string& identity) override {
    std::string first = identity;
    broadcast(first);
    refuse_where(first != identity, "another " + what + " than rank 0", "the same on all ranks");
  }

  void check_shared(const std::string& folder) override {
    std::string file = folder + "/.shared-" + std::to_string(::getpid());
    broadcast(file);
    if (rank_ == 0) {
      std::ofstream(file) << machine();
    }
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code none;
    const bool is_hidden = !std::filesystem::exists(file, none);
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank_ == 0) {
      std::filesystem::remove(file, none);
    }
    refuse_where(is_hidden, folder + " without what rank 0 writes there", "a folder that all ranks share");
  }

  void fail(const std::string& why) override {
    if (rank_ != 0) {
      const std::string message = name() + ": " + why;
      MPI_Send(message.data(), static_cast<int>(message.size()), MPI_BYTE, 0, kFailure, MPI_COMM_WORLD);
    }
  }

  int finish(int status) override {
    times_.end();
    MPI_Request barrier = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &barrier);
    const auto last = Clock::now() + std::chrono::seconds(status == 0 ? 60 : 2);
    Pause pause;
    for (int is_done = 0; true; pause.wait()) {
      MPI_Test(&barrier, &is_done, MPI_STATUS_IGNORE);
      if (is_done != 0) {
        break;
      }
      if (rank_ == 0 && Clock::now() > last) {  // some rank waits for tasks that do not come any more
        MPI_Abort(MPI_COMM_WORLD, status == 0 ? 1 : status);
      }
    }
    MPI_Finalize();
    return rank_ == 0 ? status : 0;
  }

 private:
  static int begin() {
    int level = 0, rank = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
  }

  std::string name() const { return "rank " + std::to_string(rank_) + " on " + machine(); }

  /// All ranks throw alike where one of them has found something wrong: the lowest of them is named.
  void refuse_where(bool is_wrong, const std::string& found, const std::string& expected) const {
    const int mine = is_wrong ? rank_ : size_;
    int lowest = size_;
    MPI_Allreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (lowest == size_) {
      return;
    }
    std::string text = name() + ": found " + found + ", expected " + expected;
    auto length = static_cast<std::uint64_t>(text.size());
    MPI_Bcast(&length, 1, MPI_UINT64_T, lowest, MPI_COMM_WORLD);
    text.resize(length);
    MPI_Bcast(text.data(), static_cast<int>(length), MPI_BYTE, lowest, MPI_COMM_WORLD);
    throw Refused(text);
  }

  int rank_, size_ = 1;
  Times times_;
};

}  // namespace

std::string mpi_name() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string name(text.data(), static_cast<std::size_t>(length));
  return name.substr(0, name.find_first_of(",\n"));
}

std::unique_ptr<Workers> start(const std::string& times) {
  if (started_together() > 1 || !times.empty()) {
    return std::make_unique<MpiRanks>(times);
  }
  return std::make_unique<Threads>(1);
}

}  // namespace plumbline::work
