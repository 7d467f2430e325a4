// The same commands on the ranks of an MPI job.
#include <signal.h>

#include <chrono>
#include <random>
#include <thread>

#include "tests/batch/batch_folder.h"
#include "tests/work/mpi_job.h"

namespace plumbline::test {
namespace {

using testing::HasSubstr;

class OnRanks : public BatchFolder {
 protected:
  static std::vector<std::string> command(int ranks, const std::vector<std::string>& arguments) {
    std::vector<std::string> words{"-n", std::to_string(ranks), PLUMBLINE_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  }
  JobOutcome run(int ranks, const std::vector<std::string>& arguments) const {
    return run_job(command(ranks, arguments), folder);
  }
  /// Kills a rank some time after there are any; false when all was done before.
  bool killed(int ranks, const std::vector<std::string>& arguments, int milliseconds,
              std::size_t which) const {
    MpiJob job(command(ranks, arguments), folder);
    while (job.is_running() && job.ranks().empty()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    const std::vector<pid_t> processes = job.ranks();
    const bool is_running = job.is_running() && !processes.empty();
    if (is_running) {
      ::kill(processes[which % processes.size()], SIGKILL);
    }
    return job.wait().status != 0 && is_running;
  }
  void expect_nothing_lost(int instants, int longest, unsigned seed) const {
    ASSERT_EQ(run(1, {"batch", "jobs.yaml", "-o", "whole"}).status, 0);
    const auto whole = results("whole");
    std::mt19937 random(seed);
    int kills = 0;
    for (int i = 0; i < instants; ++i) {
      const std::string out = "killed" + std::to_string(i);
      const auto milliseconds = static_cast<int>(random() % static_cast<unsigned>(longest));
      kills += killed(3, {"batch", "jobs.yaml", "-o", out}, milliseconds, random()) ? 1 : 0;
      const JobOutcome again = run(3, {"batch", "jobs.yaml", "-o", out});
      EXPECT_EQ(again.status, 0) << again.err;
      EXPECT_EQ(results(out), whole) << "killed after " << milliseconds << " ms";
    }
    EXPECT_GT(kills, 0) << "no rank was killed while it worked";
  }
};

TEST_F(OnRanks, BatchGivesTheSameBytes) {
  write("jobs.yaml", jobs({fit_row("A", "2026-03-01"), fit_row("A", "2026-03-02"), kFails, kCompare}));
  EXPECT_EQ(plumbline({"batch", "jobs.yaml", "-o", "threads"}).status, 1);
  for (const int ranks : {1, 2, 4}) {
    const std::string out = "ranks" + std::to_string(ranks);
    EXPECT_EQ(run(ranks, {"batch", "jobs.yaml", "-o", out}).status, 1);
    EXPECT_EQ(results(out), results("threads")) << ranks << " ranks";
  }
}

TEST_F(OnRanks, NothingIsLostWhenARankIsKilled) { expect_nothing_lost(2, 2500, 20261128); }

TEST_F(OnRanks, BadInputIsSaidOnce) {
  write("jobs.yaml", jobs({"{label: a, trials: []}"}));
  const JobOutcome outcome = run(3, {"batch", "jobs.yaml", "-o", "out"});
  EXPECT_EQ(outcome.status, 2);
  const std::size_t said = outcome.err.find("expected one trial at least");
  EXPECT_NE(said, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("expected one trial at least", said + 1), std::string::npos) << outcome.err;
}

TEST_F(OnRanks, MoreRanksThanRowsIsSaid) {
  write("jobs.yaml", jobs({kCompare}));
  const JobOutcome outcome = run(3, {"batch", "jobs.yaml", "-o", "out"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "plumbline: 1 rows for 3 ranks: 2 of them have nothing to do\n");
}

TEST_F(OnRanks, OtherCommandsAreDoneByOneRank) {
  const JobOutcome outcome = run(3, {"check", "robot/model.yaml"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, plumbline({"check", "robot/model.yaml"}).out);
  EXPECT_EQ(outcome.err, "plumbline: `check` is no work for several ranks: one of 3 does it\n");
}

// A copy of the program that differs by one byte behind its end.
TEST_F(OnRanks, OfDifferentProgramsAreRefused) {
  const std::string other = folder + "/other";
  std::filesystem::copy_file(PLUMBLINE_PROGRAM, other);
  std::ofstream(other, std::ios::app | std::ios::binary) << '\n';
  const JobOutcome outcome = run_job(
      {"-n", "1", PLUMBLINE_PROGRAM, "batch", "jobs.yaml", ":", "-n", "1", other, "batch", "jobs.yaml"},
      folder);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("plumbline: rank 1 on "));
  EXPECT_THAT(outcome.err, HasSubstr("found another version of the program than rank 0"));
}

TEST_F(OnRanks, AFolderThatIsNotSharedIsRefused) {
  std::filesystem::create_directories(folder + "/elsewhere");
  const std::string jobs = folder + "/jobs.yaml";
  const JobOutcome outcome =
      run_job({"-n", "1", PLUMBLINE_PROGRAM, "batch", jobs, "-o", "out", ":", "-n", "1", "--wdir",
               folder + "/elsewhere", PLUMBLINE_PROGRAM, "batch", jobs, "-o", "out"},
              folder);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("expected a folder that all ranks share"));
}

#ifdef PLUMBLINE_SLOW
TEST_F(OnRanks, NothingIsLostAtTenInstants) {
  write("jobs.yaml", jobs({"{robot: A, most: 1, trials: [trials/chirp, trials/swing]}",
                           fit_row("A", "2026-03-01"), fit_row("A", "2026-03-02"), kCompare}));
  expect_nothing_lost(10, 12000, 7);
}

TEST_F(OnRanks, ADiagnosisGivesTheSameBytes) {
  const std::vector<std::string> trials{"trials/chirp", "trials/steps", "trials/swing"};
  const auto arguments = [&](const std::string& json) {
    std::vector<std::string> words{"diagnose", "--json", json, "--resume", json + ".kept"};
    words.insert(words.end(), trials.begin(), trials.end());
    return words;
  };
  succeed(arguments("threads.json"));
  for (const int ranks : {2, 4}) {
    const std::string name = "ranks" + std::to_string(ranks) + ".json";
    // Killed in the middle, it goes on from what was kept.
    killed(ranks, arguments(name), 3000, 1);
    const JobOutcome outcome = run(ranks, arguments(name));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(read(name), read("threads.json")) << ranks << " ranks";
  }
}
#endif

}  // namespace
}  // namespace plumbline::test
