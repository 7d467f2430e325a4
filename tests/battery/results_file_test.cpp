// A battery that was stopped goes on from its file.
#include "tests/battery/results_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace plumbline::battery {
namespace {

class ResultsFileTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove(file_); }
  void TearDown() override { std::filesystem::remove(file_); }

  /// A pair with a value found, of the battery's own table.
  static Result result() {
    Result r;
    for (const Case& one : all_cases()) {
      if (one.kind == Kind::pair) {
        r.one = one;
        break;
      }
    }
    r.verdict = "missing";
    r.first = "coulomb@mLA";
    r.visible = r.right = true;
    r.before = 3.5;
    r.after = 1.0 / 3.0;
    r.seconds = 41.5;
    r.processor_seconds = 80.25;
    r.recovered = {{"coulomb@mLA:torque", 0.1, 0.12, 0.009}};
    return r;
  }

  void append(const std::string& text) const { std::ofstream(file_, std::ios::app) << text; }

  std::string file_ =
      (std::filesystem::temp_directory_path() / ("plumbline_results_" + std::to_string(getpid()))).string();
  RunOptions options_{7};
};

TEST_F(ResultsFileTest, KeepsWhatTheScoreboardCounts) {
  const Result put = result();
  ResultsFile(file_, options_).add(put);
  const ResultsFile again(file_, options_);
  const Result* got = again.find(put.one.name);
  ASSERT_NE(got, nullptr);
  EXPECT_EQ(got->one.kind, Kind::pair);
  EXPECT_EQ(got->first, put.first);
  EXPECT_TRUE(got->visible && got->right);
  EXPECT_EQ(got->after, put.after);
  EXPECT_EQ(got->processor_seconds, put.processor_seconds);
  ASSERT_EQ(got->recovered.size(), 1U);
  EXPECT_FALSE(got->recovered[0].is_inside());
  EXPECT_EQ(again.find("leg_bench/none/1"), nullptr);
}

TEST_F(ResultsFileTest, DropsALineThatWasNotWrittenToItsEnd) {
  ResultsFile(file_, options_).add(result());
  append("{\"case\": \"leg_ben");
  ResultsFile(file_, options_).add(result());
  EXPECT_EQ(ResultsFile(file_, options_).results().size(), 2U);
}

TEST_F(ResultsFileTest, RefusesOtherOptionsAndLeavesTheFileAlone) {
  ResultsFile(file_, options_).add(result());
  append("half a line");
  const auto size = std::filesystem::file_size(file_);
  RunOptions other = options_;
  other.seed = 8;
  EXPECT_THAT([&] { const ResultsFile wrong(file_, other); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::AllOf(testing::HasSubstr(file_ + ":1: found"), testing::HasSubstr("\"seed\":7"))));
  EXPECT_EQ(std::filesystem::file_size(file_), size);
}

TEST_F(ResultsFileTest, NamesTheLineThatIsNoResult) {
  ResultsFile(file_, options_).add(result());
  append("{\"case\": \"leg_bench/none/1\"}\n");
  EXPECT_THAT([&] { const ResultsFile wrong(file_, options_); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::AllOf(testing::HasSubstr(file_ + ":3: "), testing::HasSubstr("with"))));
}

TEST_F(ResultsFileTest, TellsHowLongCasesTook) {
  ResultsFile(file_, options_).add(result());
  append("{\"case\": \"leg_ben");
  work::Durations durations;
  add_durations(file_, durations);
  EXPECT_EQ(durations.of(result().one.name), 80.25);
  EXPECT_EQ(durations.of("leg_ben"), 0.0);
  EXPECT_THROW(add_durations(file_ + ".not", durations), std::runtime_error);
}

}  // namespace
}  // namespace plumbline::battery
