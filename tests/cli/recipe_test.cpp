// `plumbline fit --recipe` as a user runs it.
#include <gmock/gmock.h>

#include "tests/cli/robot_folder.h"
#include "tests/studies/recipes/pendulum_recipe.h"

namespace plumbline::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

class RecipeCommand : public RobotFolder {
 protected:
  void SetUp() override {
    RobotFolder::SetUp();
    write("recipes/recipe.yaml",
          with(pendulum_recipe(), "window_fit\n", "window_fit\n    window: {value: 0.25, unit: s}\n"));
  }
};

TEST_F(RecipeCommand, PrintsTrueAndRecoveredValues) {
  const Outcome outcome = succeed({"fit", "--recipe", "recipes", "--seed", "2", "--json", "out.json"});
  EXPECT_THAT(outcome.out, HasSubstr("met"));
  EXPECT_THAT(outcome.out, HasSubstr("1 of 1 targets met"));
  const json all = read_json("out.json");
  EXPECT_THAT(keys(all), UnorderedElementsAre("recipe", "title", "confidence", "covered", "known",
                                              "targets_met", "targets", "steps"));
  const json step = all["steps"][0];
  EXPECT_THAT(keys(step), UnorderedElementsAre("step", "title", "source", "method", "carried", "before",
                                               "after", "used", "converged", "seconds", "findings",
                                               "correlations", "not_identifiable", "weak"));
  const json found = step["findings"][0];
  EXPECT_THAT(keys(found), UnorderedElementsAre("unknown", "unit", "true", "recovered", "standard_deviation",
                                                "interval", "seen", "covered", "target", "met"));
  EXPECT_NEAR(found["recovered"].get<double>(), found["true"].get<double>(),
              0.02 * found["true"].get<double>());
}

TEST_F(RecipeCommand, ExitStatusSaysThatATargetWasMissed) {
  replace("recipes/recipe.yaml", "target: 2 %", "target: 1e-9 %");
  const Outcome outcome = plumbline({"fit", "--recipe", "recipes", "--seed", "2"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("missed"));
}

TEST_F(RecipeCommand, RecordedTrialsNeedNoSeedAndHaveNoTruth) {
  write("recipes/recorded.yaml",
        with(pendulum_recipe(), "experiments: [" + pendulum_robot("experiments/chirp.yaml"),
             "trials: [../trials/chirp"));
  const Outcome outcome = succeed({"fit", "--recipe", "recipes/recorded.yaml", "--json", "out.json"});
  const json found = read_json("out.json")["steps"][0]["findings"][0];
  EXPECT_TRUE(found["true"].is_null());
  EXPECT_TRUE(found["met"].is_null());
}

TEST_F(RecipeCommand, WrongUsageIsRefusedInOneLine) {
  const auto refusal = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = plumbline(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(refusal({"fit"}), HasSubstr("trial"));
  EXPECT_THAT(refusal({"fit", "trials/chirp"}), HasSubstr("--free"));
  EXPECT_THAT(refusal({"fit", "--recipe", "recipes"}), HasSubstr("--seed"));
  EXPECT_THAT(refusal({"fit", "--recipe", "nowhere.yaml", "--seed", "1"}), HasSubstr("nowhere.yaml"));
  EXPECT_THAT(refusal({"fit", "trials/chirp", "--recipe", "recipes"}), HasSubstr("--recipe"));
  EXPECT_THAT(refusal({"fit", "trials/chirp", "--free", "*", "--seed", "1"}), HasSubstr("--seed"));
}

}  // namespace
}  // namespace plumbline::test
