// Commands on the ranks of an MPI job: the same bytes on any number of them.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "tests/cli/program.h"
#include "tests/trace/temporary_folder.h"
#include "tests/work/mpi_job.h"

namespace plumbline::test {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;
using testing::Not;

const std::string kMabel = PLUMBLINE_ROOT "/robots/mabel";

/// What a run printed, and the file that it wrote.
struct Said {
  int status = -1;
  std::string out, file;
};

class CommandOnRanks : public ::testing::Test {
 protected:
  /// Without mpirun where ranks is 0. `written` is the file that the command writes.
  Said said(int ranks, std::vector<std::string> words, const std::string& written) {
    fs::remove(folder.path(written));
    std::string out, err;
    Said result;
    if (ranks == 0) {
      const Outcome outcome = run(words, folder.path("."));
      result = {outcome.status, outcome.out, ""};
      err = outcome.err;
    } else {
      words.insert(words.begin(), {"-n", std::to_string(ranks), PLUMBLINE_PROGRAM});
      const JobOutcome outcome = run_job(words, folder.path("."));
      result = {outcome.status, outcome.out, ""};
      err = outcome.err;
    }
    EXPECT_THAT(err, Not(HasSubstr("plumbline:"))) << ranks << " ranks";  // not that the work is not shared
    result.file = fs::exists(folder.path(written)) ? folder.read(written) : "";
    return result;
  }
  void expect_same_bytes(const std::vector<std::string>& words, const std::string& written) {
    const Said alone = said(0, words, written);
    EXPECT_NE(alone.file, "");
    for (const int ranks : {1, 2, 4}) {
      const Said among = said(ranks, words, written);
      EXPECT_EQ(among.status, alone.status) << ranks << " ranks";
      EXPECT_EQ(among.out, alone.out) << ranks << " ranks";
      EXPECT_EQ(among.file, alone.file) << ranks << " ranks";
    }
  }
  TemporaryFolder folder;
};

TEST_F(CommandOnRanks, TuneFindsTheSame) {
  expect_same_bytes({"tune", kMabel + "/tune/hopping.yaml", "--trials", "2", "--starts", "1", "--enough", "2",
                     "--tolerance", "1e-3", "--json", "tune.json"},
                    "tune.json");
}

TEST_F(CommandOnRanks, StepDownFindsTheSame) {
  expect_same_bytes({"study", "step-down", kMabel + "/step_down.yaml", "--controller", "baseline", "--height",
                     "9", "40", "--json", "down.json"},
                    "down.json");
}

TEST_F(CommandOnRanks, BothRanksWork) {
  ::setenv("PLUMBLINE_WORK_TIMES", folder.path("times.csv").c_str(), 1);
  said(2,
       {"study", "step-down", kMabel + "/step_down.yaml", "--controller", "baseline", "--height", "9", "40"},
       "none");
  ::unsetenv("PLUMBLINE_WORK_TIMES");
  const std::string times = folder.read("times.csv");
  EXPECT_THAT(times, HasSubstr("step down 0,"));
  EXPECT_THAT(times, HasSubstr("step down 1,"));
  EXPECT_THAT(times, testing::ContainsRegex("step down [01],0,"));
  EXPECT_THAT(times, testing::ContainsRegex("step down [01],1,"));
}

TEST_F(CommandOnRanks, ValidateFindsTheSame) {
  expect_same_bytes({"validate", kMabel, "--gait", "hopping", "--cycles", "1", "--starts", "2", "--enough",
                     "15", "--no-orbit", "--no-held", "--tolerance", "1e-3", "--json", "validated.json"},
                    "validated.json");
}

}  // namespace
}  // namespace plumbline::test
