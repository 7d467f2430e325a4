// Trials of role test are neither fitted nor used to choose; the error of what was chosen is reported on
// them.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/fit/fit.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

constexpr const char* kFolder = PLUMBLINE_ROOT "/tests/robots/pendulum/";

model::Model pendulum() {
  return model::read_model(std::string(kFolder) + "model.yaml", model::known_effects());
}

/// A second of the experiment, recorded from the pendulum with more friction than stated.
Trial recorded(const std::string& experiment, Role role) {
  model::Model robot = pendulum();
  robot.effects.front().values.front().value *= 1.5;
  Experiment one = read_experiment(std::string(kFolder) + "experiments/" + experiment, robot);
  one.time.conservativeResize(1000);
  for (Command& command : one.commands) {
    command.values.conservativeResize(1000);
  }
  one.role = role;
  Trial trial = twin(robot, one, {});
  trial.name = to_string(role);
  return trial;
}

Data with_test() {
  return Data({recorded("multisine.yaml", Role::test), recorded("steps.yaml", Role::train)}, {});
}

TEST(TestRole, StandsApartFromAllThatIsFittedOrChooses) {
  const Data data = with_test();
  ASSERT_EQ(data.trials.size(), 1U);
  EXPECT_EQ(data.trials.front().role, Role::train);
  ASSERT_EQ(data.tests.size(), 1U);
  EXPECT_EQ(data.windows.size(), 2U);
  EXPECT_EQ(data.of_tests().windows.size(), 2U);
}

// A limit holds for each role by itself, tests included, and its windows are spread over the trials.
TEST(TestRole, ALimitSpreadsTheWindowsOfEachRole) {
  PredictOptions options;
  options.window = 0.1;
  Data data({recorded("multisine.yaml", Role::test), recorded("steps.yaml", Role::train),
             recorded("steps.yaml", Role::train), recorded("multisine.yaml", Role::held_out)},
            options);
  ASSERT_EQ(data.windows.size(), 30U);
  data.limit(4);
  EXPECT_EQ(data.windows_of(Role::train).size(), 4U);
  EXPECT_EQ(data.windows_of(Role::held_out).size(), 4U);
  EXPECT_EQ(data.of_tests().windows.size(), 4U);
  EXPECT_EQ(data.unused_windows, 22U);
  std::vector<int> trials;
  std::vector<Eigen::Index> firsts;
  for (const int w : data.windows_of(Role::train)) {
    trials.push_back(data.windows[static_cast<std::size_t>(w)].trial);
    firsts.push_back(data.windows[static_cast<std::size_t>(w)].first);
  }
  EXPECT_EQ(trials, (std::vector<int>{0, 0, 1, 1}));
  EXPECT_EQ(firsts[0], firsts[2]);
  EXPECT_GT(firsts[1], firsts[0] + 300);
  EXPECT_THROW(data.limit(0), InputError);
}

TEST(TestRole, IsComparedAsTheOthers) {
  const Comparison all = compare(pendulum(), with_test());
  EXPECT_GT(all.scores.train, 1.5);
  EXPECT_GT(all.scores.test, 1.5);
  EXPECT_EQ(all.scores.held_out, 0.0);
  ASSERT_EQ(all.channels.size(), 4U);
  EXPECT_EQ(all.channels.front().role, Role::train);
  EXPECT_EQ(all.channels.back().role, Role::test);
  EXPECT_EQ(all.windows.size(), 4U);
}

TEST(TestRole, ChangesNoFitAndSaysHowGoodItIs) {
  const auto fitted = [](const Data& data) {
    return fit(pendulum(), data, matching(free_parameters(pendulum()), {"viscous@drive:damping"}), {},
               [](const std::string&, double) {});
  };
  const Fit with = fitted(with_test());
  const Fit without = fitted(Data({recorded("steps.yaml", Role::train)}, {}));
  EXPECT_EQ(with.parameters.front().after, without.parameters.front().after);
  EXPECT_EQ(with.parameters.front().deviation, without.parameters.front().deviation);
  EXPECT_GT(with.before.test, 1.5);
  EXPECT_LT(with.after.test, 1.2);
  EXPECT_EQ(without.after.test, 0.0);
}

// It was a residual of a million floors, which looks like a number.
TEST(Estimate, AWindowThatCannotBeIntegratedHasNoError) {
  PredictOptions options;
  options.most_steps = 1e-3;
  const Data data({recorded("steps.yaml", Role::train)}, options);
  PredictorPool pool(pendulum(), data);
  EXPECT_TRUE(std::isinf(estimate(pool, {}, Eigen::VectorXd(), {}, {}).scores.train));
}

}  // namespace
}  // namespace plumbline::validation
