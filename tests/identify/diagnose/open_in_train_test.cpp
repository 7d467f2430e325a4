// A law that the train motion hardly stirs and the held-out motion shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/model/robot_file.h"
#include "tests/identify/diagnose/bench.h"
#include "validation/identify/twin/twin.h"
#include "validation/report/sentences.h"

namespace plumbline::validation {
namespace {

Trial recorded(const model::Model& robot, const model::Model& bare, const std::string& name, double size) {
  Experiment experiment = read_experiment("tests/robots/pendulum/experiments/" + name + ".yaml", bare);
  for (Command& command : experiment.commands) {
    command.values *= size;
  }
  Trial trial = twin(robot, experiment, {});
  trial.name = trial.file = name;
  return trial;
}

// The train trials come from the pendulum without the law: nothing is its best value for them, if only just.
TEST(OpenInTrain, TheHeldOutMotionGivesTheValue) {
  const model::Model bare = model::read_model("tests/robots/pendulum/model.yaml", effects::Catalogue::all());
  model::Model robot = bare;
  robot.effects.push_back(parse_effect("quadratic@drive:drag=5e-9", bare, effects::Catalogue::all()));
  std::vector<Trial> trials;
  trials.push_back(recorded(bare, bare, "steps", 0.05));
  trials.push_back(recorded(robot, bare, "multisine", 1.0));
  const Diagnosis found = diagnose(bare, some_laws({"quadratic"}), Data(std::move(trials), {}), {}, silent);
  ASSERT_EQ(found.accepted.size(), 1U);
  const Finding& finding = found.accepted.front();
  EXPECT_TRUE(finding.open_in_train);
  EXPECT_NEAR(finding.parameters.front().value, 5e-9, 5e-10);
  EXPECT_LT(found.ladder.back().held_out(), 1.1);
  EXPECT_GT(found.ladder.front().held_out(), 1.3);
  EXPECT_THAT(finding_sentences(finding, found), testing::HasSubstr("what the held-out ones ask for"));
}

}  // namespace
}  // namespace plumbline::validation
