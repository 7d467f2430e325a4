// Tasks in, results in order out: the ranks of an MPI job, of a small program of their own.
#include <gmock/gmock.h>

#include <filesystem>

#include "tests/trace/temporary_folder.h"
#include "tests/work/mpi_job.h"

namespace plumbline::test {
namespace {

using testing::HasSubstr;

class Ranks : public ::testing::Test {
 protected:
  JobOutcome run(int ranks, std::vector<std::string> words) {
    words.insert(words.begin(), {"-n", std::to_string(ranks), PLUMBLINE_RANKS});
    return run_job(words, folder.path("."));
  }
  TemporaryFolder folder;
};

TEST_F(Ranks, GiveTheSameBytesHoweverManyThereAre) {
  const JobOutcome one = run(1, {"30"});
  ASSERT_EQ(one.status, 0) << one.err;
  for (const int ranks : {2, 4, 7}) {
    const JobOutcome some = run(ranks, {"30"});
    EXPECT_EQ(some.status, 0) << some.err;
    EXPECT_EQ(some.out, one.out) << ranks << " ranks";
  }
}

TEST_F(Ranks, MayBeMoreThanTheTasks) { EXPECT_EQ(run(5, {"2"}).out, run(1, {"2"}).out); }

TEST_F(Ranks, DoWhatATaskAsksForWhereItIs) {
  EXPECT_EQ(run(3, {"9", "nested"}).out, run(2, {"9", "nested"}).out);
}

TEST_F(Ranks, SayWhyATaskHasFailed) {
  for (const int ranks : {1, 3}) {
    const JobOutcome outcome = run(ranks, {"9", "fail", "4"});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr("first: task 4 has failed\n"));
    EXPECT_EQ(outcome.out, "");
  }
}

TEST_F(Ranks, RefuseOtherTasksOnOtherRanks) {
  const JobOutcome outcome = run(2, {"9", "differ"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("first: rank 1 has come to other tasks than the first rank"));
}

TEST_F(Ranks, RefuseAFolderThatIsNotTheSame) {
  std::filesystem::create_directories(folder.path("a/out"));
  std::filesystem::create_directories(folder.path("b/out"));
  const std::vector<std::string> words{PLUMBLINE_RANKS, "3", "shared", "out"};
  const auto in = [&](const std::string& where) {
    std::vector<std::string> part{"-n", "1", "--wdir", folder.path(where)};
    part.insert(part.end(), words.begin(), words.end());
    return part;
  };
  std::vector<std::string> apart = in("a"), together = in("a");
  for (const std::string& word : in("b")) {
    apart.push_back(word == "-n" ? ":" : word);
    if (word == "-n") {
      apart.push_back("-n");
    }
  }
  const JobOutcome refused = run_job(apart, folder.path("."));
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("first: rank 1 on "));
  EXPECT_THAT(refused.err, HasSubstr("expected a folder that all ranks share"));
  together[1] = "3";
  EXPECT_EQ(run_job(together, folder.path(".")).status, 0);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("a/out")));
}

}  // namespace
}  // namespace plumbline::test
