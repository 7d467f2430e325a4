// Ctrl-C in the middle of long work.
#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

class Interrupt : public RobotFolder {
 protected:
  /// long/steps: so long that nothing can be done with it in a moment.
  void make_long_trial() const {
    replace("experiments/steps.yaml", "duration: {value: 2, unit: s}", "duration: {value: 40, unit: s}");
    succeed({"twin", "--model", "robot/model.yaml", "--with", "coulomb@drive:level=0.008", "--experiment",
             "experiments/steps.yaml", "--out", "long"});
  }

  /// Starts the command on a terminal and interrupts it as soon as that shows the text; it must end soon.
  Outcome interrupted_at(const std::string& text, const std::vector<std::string>& arguments) const {
    Process process(arguments, folder, Errors::terminal);
    EXPECT_TRUE(process.wait_for_shown(text));
    return interrupted(process);
  }

  static Outcome interrupted(Process& process) {
    EXPECT_TRUE(process.is_running()) << "it was done before it could be interrupted";
    const double before = process.processor_seconds();
    process.interrupt();
    Outcome outcome = process.wait();
    EXPECT_LT(process.processor_seconds() - before, 15.0) << "it went on working";
    return outcome;
  }
};

TEST_F(Interrupt, DiagnoseKeepsWhatIsFinished) {
  make_long_trial();
  const Outcome outcome =
      interrupted_at("screening", {"diagnose", "long/steps", "--json", "d.json", "--save", "found.yaml"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("Stopped before the end"));
  const nlohmann::json json = read_json("d.json");
  EXPECT_THAT(keys(json), testing::IsSupersetOf({"verdict", "interrupted", "candidates", "unexplained_share",
                                                 "accepted", "ranking", "leads", "ladder"}));
  EXPECT_EQ(json["interrupted"], true);
  ASSERT_GE(json["ladder"].size(), 1U);
  EXPECT_THAT(keys(json["ladder"][0]),
              testing::UnorderedElementsAre("name", "length", "train", "held_out", "predictive"));
  EXPECT_EQ(json["ladder"][0]["name"], "as given");
  succeed({"check", "found.yaml"});
}

TEST_F(Interrupt, DiagnoseGoesOnFromItsResults) {
  make_long_trial();
  const std::vector<std::string> arguments{"diagnose", "long/steps", "--resume", "kept.txt"};
  const Outcome first = interrupted_at("screening", arguments);
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, testing::HasSubstr("The same command goes on from the results in kept.txt"));
  interrupted_at("going on from", arguments);
  replace("long/steps/trial.yaml", "role: train", "role: train # again");
  const Outcome other = plumbline(arguments);
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, testing::HasSubstr("kept.txt:1: found results of other files"));
}

TEST_F(Interrupt, DiagnoseEndsCleanlyBeforeAnythingIsFinished) {
  make_long_trial();
  const Outcome outcome = interrupted_at(
      "the model as given", {"diagnose", "long/steps", "--json", "d.json", "--save", "found.yaml"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json json = read_json("d.json");
  EXPECT_EQ(json["interrupted"], true);
  EXPECT_EQ(json["ladder"].size(), 0U);
  EXPECT_EQ(snapshot().count("found.yaml"), 0U) << "a model was written although nothing is known";
}

TEST_F(Interrupt, FitWritesNothing) {
  make_long_trial();
  const auto before = snapshot();
  const Outcome outcome = interrupted_at(
      "the model as given", {"fit", "long/steps", "--free", "*", "--out", "fitted.yaml", "--json", "f.json"});
  EXPECT_EQ(outcome.status, 130);
  EXPECT_THAT(outcome.err, testing::HasSubstr("plumbline: stopped by the user"));
  EXPECT_THAT(changed_since(before), testing::IsEmpty());
}

TEST_F(Interrupt, ReportWritesNoHalfPage) {
  make_long_trial();
  const auto before = snapshot();
  for (const std::string how : {"--most=1", "--no-diagnose"}) {
    const Outcome outcome =
        interrupted_at(how == "--no-diagnose" ? "comparing model.yaml" : "the model as given",
                       {"report", "long/steps", how, "-o", "r.html", "--json", "r.json"});
    EXPECT_EQ(outcome.status, 130);
    EXPECT_THAT(outcome.err, testing::HasSubstr("plumbline: stopped by the user"));
    EXPECT_THAT(changed_since(before), testing::IsEmpty());
  }
}

TEST_F(Interrupt, SimulateWritesNothing) {
  replace("experiments/swing.yaml", "duration: {value: 2, unit: s}", "duration: {value: 1000, unit: s}");
  const auto before = snapshot();
  Process process({"simulate", "--experiment", "experiments/swing.yaml", "--model", "robot/model.yaml",
                   "--out", "trace.csv"},
                  folder);
  process.wait_until_ready();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const Outcome outcome = interrupted(process);
  EXPECT_EQ(outcome.status, 130);
  EXPECT_EQ(outcome.err, "plumbline: stopped by the user\n");
  EXPECT_THAT(changed_since(before), testing::IsEmpty());
}

}  // namespace
}  // namespace plumbline::test
