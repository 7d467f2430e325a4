// `plumbline batch` as a user runs it.
#include "tests/batch/batch_folder.h"

namespace plumbline::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Batch : public BatchFolder {};

TEST_F(Batch, RunsEveryRow) {
  const Outcome outcome = succeed({"batch", "jobs.yaml", "-o", "out"});
  EXPECT_THAT(outcome.out, HasSubstr("A_2026-03-01"));
  const auto files = results("out");
  ASSERT_EQ(files.size(), 6U);  // three rows and their folder, page and table
  const nlohmann::json row = read_json("out/rows/A_2026-03-01.json");
  EXPECT_EQ(row["plumbline"], "batch_row/1");
  EXPECT_EQ(row["status"], "done");
  EXPECT_EQ(row["model"], "robot/model.yaml");
  // The same as the command that does this row alone.
  succeed({"fit", "trials/chirp", "trials/swing", "--model", "robot/model.yaml", "--free",
           "viscous@*:damping", "--json", "fit.json"});
  EXPECT_EQ(row["result"]["parameters"], read_json("fit.json")["parameters"]);
  EXPECT_EQ(row["errors"]["held_out"], read_json("fit.json")["after"]["held_out"]);
  succeed(
      {"compare", "trials/chirp", "trials/swing", "--model", "robot/model.yaml", "--json", "compare.json"});
  EXPECT_EQ(read_json("out/rows/all.json")["result"], read_json("compare.json"));
  EXPECT_THAT(files.at("/batch.html"), HasSubstr("<svg"));
  EXPECT_THAT(files.at("/batch.csv"), HasSubstr("A_2026-03-02,A,2026-03-02,fit,done,"));
}

TEST_F(Batch, DoesNotRunAFinishedRowAgain) {
  succeed({"batch", "jobs.yaml", "-o", "out"});
  const auto before = results("out");
  const auto time = [&](const char* row) {
    return std::filesystem::last_write_time(folder + "/out/rows/" + row + ".json");
  };
  const auto first = time("A_2026-03-01"), other = time("all");
  succeed({"batch", "jobs.yaml", "-o", "out"});
  EXPECT_EQ(time("A_2026-03-01"), first);
  EXPECT_EQ(results("out"), before);
  // Another option is another input, of the rows that it is for.
  replace("jobs.yaml", "{label: all, ", "{label: all, window: {value: 0.25, unit: s}, ");
  succeed({"batch", "jobs.yaml", "-o", "out"});
  EXPECT_EQ(time("A_2026-03-01"), first);
  EXPECT_NE(time("all"), other);
}

TEST_F(Batch, AFailedRowSaysWhyAndStopsNoOther) {
  write("jobs.yaml", jobs({kFails, kCompare}));
  const Outcome outcome = plumbline({"batch", "jobs.yaml", "-o", "out"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("FAILED"));
  EXPECT_THAT(outcome.out, HasSubstr("1 of 2 rows failed"));
  EXPECT_THAT(read_json("out/rows/nowhere.json")["why"].get<std::string>(),
              HasSubstr("nothing: found nothing at this path"));
  EXPECT_EQ(read_json("out/rows/all.json")["status"], "done");
  EXPECT_THAT(read("out/batch.html"), HasSubstr("failed: "));
  // Mended, it is run and the other is not.
  const auto time = std::filesystem::last_write_time(folder + "/out/rows/all.json");
  replace("jobs.yaml", "[nothing]", "[trials/swing]");
  succeed({"batch", "jobs.yaml", "-o", "out"});
  EXPECT_EQ(std::filesystem::last_write_time(folder + "/out/rows/all.json"), time);
}

// As an array of jobs does it: parts that share a folder, then the whole.
TEST_F(Batch, IsDoneInParts) {
  succeed({"batch", "jobs.yaml", "-o", "whole"});
  succeed({"batch", "jobs.yaml", "-o", "out", "--part", "2/2"});
  EXPECT_FALSE(std::filesystem::exists(folder + "/out/batch.html"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/out/rows/all.json"));
  succeed({"batch", "jobs.yaml", "-o", "out", "--part", "1/2"});
  const auto time = std::filesystem::last_write_time(folder + "/out/rows/all.json");
  succeed({"batch", "jobs.yaml", "-o", "out"});
  EXPECT_EQ(std::filesystem::last_write_time(folder + "/out/rows/all.json"), time);
  EXPECT_EQ(results("out"), results("whole"));
  for (const char* part : {"3/2", "0/2", "1", "1/2x"}) {
    EXPECT_EQ(plumbline({"batch", "jobs.yaml", "-o", "out", "--part", part}).status, 2) << part;
  }
}

TEST_F(Batch, RefusesBadInputInOneLine) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {jobs({}), "rows: found nothing, expected a list"},
      {jobs({"{label: a, trials: [x], moed: fit}"}), "unknown key"},
      {jobs({"{label: a, trials: [x], mode: guess}"}), "expected diagnose, compare or fit"},
      {jobs({"{label: a, trials: [x], mode: fit}"}), "mode fit without free"},
      {jobs({"{label: a/b, trials: [x]}"}), "expected a label of letters"},
      {jobs({"{label: a, trials: []}"}), "expected one trial at least"},
      {jobs({"{label: a, trials: [x]}", "{label: a, trials: [x]}"}), "expected a label of its own"},
      {jobs({"{label: a, day: yesterday, trials: [x]}"}), "expected a date such as 2026-03-14"},
      {jobs({"{label: a, most: 1.5, trials: [x]}"}), "expected a whole number"},
      {"plumbline: batch/2\ntitle: a\nrows: []\n", "expected"}};
  for (const auto& [text, message] : wrong) {
    write("jobs.yaml", text);
    const Outcome outcome = plumbline({"batch", "jobs.yaml", "-o", "out"});
    EXPECT_EQ(outcome.status, 2) << text;
    EXPECT_THAT(outcome.err, HasSubstr("plumbline: jobs.yaml")) << text;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << text;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder + "/out"));
  }
  write("jobs.yaml", jobs({kCompare}));
  write("taken", "a file");
  EXPECT_EQ(plumbline({"batch", "jobs.yaml", "-o", "taken"}).status, 2);
}

}  // namespace
}  // namespace plumbline::test
