// Every command explains itself with an example that is a real command line.
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

using testing::HasSubstr;

std::string name_of(const testing::TestParamInfo<std::string>& command) {
  std::string name = command.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class Help : public testing::TestWithParam<std::string> {};

TEST_P(Help, ShowsUsageJsonOptionAndAnExample) {
  const Outcome outcome = run({GetParam(), "--help"}, "/");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("Usage:"));
  EXPECT_THAT(outcome.out, HasSubstr("--json FILE"));
  EXPECT_THAT(outcome.out, HasSubstr("Example:\n  plumbline " + GetParam() + " "));
}

/// The words of the example, without the quotation marks of a shell.
std::vector<std::string> example_of(const std::string& command) {
  const std::string text = run({command, "--help"}, "/").out;
  const std::string start = "Example:\n  plumbline ";
  const std::size_t at = text.find(start);
  std::vector<std::string> words;
  if (at != std::string::npos) {
    std::istringstream line(
        text.substr(at + start.size(), text.find('\n', at + start.size()) - at - start.size()));
    for (std::string word; line >> word;) {
      word.erase(std::remove(word.begin(), word.end(), '\''), word.end());
      words.push_back(word);
    }
  }
  return words;
}

TEST_P(Help, ExampleUsesOnlyOptionsThatExist) {
  // A word behind the example that no command takes: were an option of the example unknown too, the message
  // would name both.
  std::vector<std::string> words = example_of(GetParam());
  ASSERT_FALSE(words.empty());
  words.emplace_back("--no-such-option");
  const Outcome outcome = run(words, "/");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("The following argument was not expected: --no-such-option"));
}

INSTANTIATE_TEST_SUITE_P(Commands, Help,
                         testing::Values("effects", "check", "simulate", "compare", "fit", "diagnose", "add",
                                         "ladder", "suggest", "report", "new-trial", "twin", "tune",
                                         "validate", "render", "export"),
                         name_of);

TEST(Program, ListsEveryCommand) {
  const Outcome outcome = run({"--help"}, "/");
  EXPECT_EQ(outcome.status, 0);
  for (const char* command : {"effects", "check", "simulate", "compare", "fit", "diagnose", "add", "ladder",
                              "suggest", "report", "new-trial", "twin", "tune", "validate", "render"}) {
    EXPECT_THAT(outcome.out, HasSubstr(std::string("\n  ") + command + " "));
  }
}

TEST(Program, ListsCommandsInTheOrderOfUse) {
  const std::string out = run({"--help"}, "/").out;
  std::size_t before = 0;
  for (const char* line : {"A model and its measurements:\n  check ", "\n  new-model ", "\n  new-trial ",
                           "\n  compare ", "\n  diagnose ", "\n  add ", "\n  fit ", "\n  ladder ",
                           "\n  report ", "\n  export ", "from the published gait to the robot:\n  validate ",
                           "\n  certify ", "\n  robot ", "Studies of single papers:\n  study "}) {
    const std::size_t at = out.find(line);
    ASSERT_NE(at, std::string::npos) << line;
    EXPECT_GT(at, before) << line;
    before = at;
  }
  EXPECT_THAT(out, testing::Not(HasSubstr("\n  gait ")));
}

TEST(Program, OldNamesOfStudiesStillWorkAndSaySo) {
  for (const std::string study : {"gait", "running", "step-down", "spring-mass"}) {
    const Outcome now = run({"study", study, "--help"}, "/");
    EXPECT_EQ(now.status, 0);
    EXPECT_EQ(now.err, "");
    const Outcome before = run({study, "--help"}, "/");
    EXPECT_EQ(before.status, 0);
    EXPECT_EQ(before.out, now.out);
    EXPECT_EQ(before.err, "plumbline: `" + study + "` is called `study " + study +
                              "` now; the old name goes with the next version\n");
  }
}

TEST(Program, RefusesAnUnknownStudy) {
  const Outcome outcome = run({"study", "gate"}, "/");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err,
            "plumbline: found an unknown study \"gate\", expected a study; known: gait, step-down, running, "
            "spring-mass\n");
}

TEST(Program, SaysItsVersion) {
  const Outcome outcome = run({"--version"}, "/");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+ \\((no MPI|.*MPI.*)\\)\n"));
}

}  // namespace
}  // namespace plumbline::test
