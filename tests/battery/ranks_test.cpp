// The battery on the ranks of an MPI job: the same results as in one process.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/trace/temporary_folder.h"
#include "tests/work/mpi_job.h"

namespace plumbline::test {
namespace {

using nlohmann::json;

/// Without what differs from run to run: times, and whether their median meets its target.
json timeless(json value) {
  if (value.is_object()) {
    for (const char* name : {"seconds", "processor_seconds", "median_seconds", "median_processor_seconds",
                             "targets_met", "targets"}) {
      value.erase(name);
    }
    if (value.value("measure", "").rfind("seconds", 0) == 0) {  // of the scoreboard
      value.erase("measured");
      value.erase("met");
    }
  }
  for (json& part : value) {
    if (part.is_structured()) {
      part = timeless(part);
    }
  }
  return value;
}

/// The results' file by case: ranks end them in whatever order.
std::string results_in(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) {
    all.push_back(timeless(json::parse(line)).dump());
  }
  std::sort(all.begin(), all.end());
  std::string sorted;
  for (const std::string& line : all) {
    sorted += line + '\n';
  }
  return sorted;
}

TEST(BatteryOnRanks, GivesTheSameResults) {
  const TemporaryFolder folder;
  const auto run = [&](int ranks, const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{"-n", std::to_string(ranks), PLUMBLINE_BATTERY, "--seed", "1"};
    for (const char* one : {"pendulum/none/1", "pendulum/encoder_scale@shoulder/strong",
                            "pendulum/quadratic@shoulder/strong"}) {
      words.insert(words.end(), {"--only", one});
    }
    words.insert(words.end(), {"--results", name + ".jsonl", "--json", name + ".json"});
    words.insert(words.end(), more.begin(), more.end());
    const JobOutcome outcome = run_job(words, folder.path("."));
    EXPECT_LE(outcome.status, 1) << outcome.err;
  };
  run(1, "one", {});
  const std::string alone = results_in(folder.read("one.jsonl"));
  EXPECT_GT(std::count(alone.begin(), alone.end(), '\n'), 2);
  const json whole = timeless(json::parse(folder.read("one.json")));
  run(2, "two", {});
  EXPECT_EQ(results_in(folder.read("two.jsonl")), alone);
  EXPECT_EQ(timeless(json::parse(folder.read("two.json"))), whole);
  // Which of them are begun first changes nothing.
  run(2, "known", {"--durations", "one.jsonl"});
  EXPECT_EQ(results_in(folder.read("known.jsonl")), alone);
  EXPECT_EQ(timeless(json::parse(folder.read("known.json"))), whole);
}

}  // namespace
}  // namespace plumbline::test
