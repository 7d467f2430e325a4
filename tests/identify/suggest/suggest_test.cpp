// Experiments proposed for rivals on the pendulum drive of a user.
#include "validation/identify/suggest/suggest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

const auto kSilent = [](const std::string& /*what*/, double /*fraction*/) {};

model::Model pendulum() {
  return model::read_model("tests/robots/pendulum/model.yaml", effects::Catalogue::all());
}

Data trial_with(const std::string& hidden) {
  const model::Model bare = pendulum();
  model::Model robot = bare;
  robot.effects.push_back(parse_effect(hidden, bare, effects::Catalogue::all()));
  std::vector<Trial> trials;
  for (const char* name : {"chirp", "multisine"}) {
    const Experiment experiment =
        read_experiment(std::string("tests/robots/pendulum/experiments/") + name + ".yaml", bare);
    trials.push_back(twin(robot, experiment, {}));
    trials.back().name = trials.back().file = name;
  }
  return Data(std::move(trials), {});
}

TEST(Suggest, FindsAnExperimentThatTellsALagFromADelay) {
  const Data data = trial_with("actuator_lag@drive:time_constant=8e-4");
  const Suggestions found = suggest(pendulum(), effects::Catalogue::all(), data,
                                    {"actuator_lag@drive", "command_delay@drive"}, kSilent);
  EXPECT_TRUE(found.inseparable.empty());
  ASSERT_GT(found.experiments.size(), 3U);
  const Separation& best = found.experiments.front();
  const Separation& worst = found.experiments.back();
  EXPECT_TRUE(std::isfinite(best.seconds));
  EXPECT_LT(best.seconds, worst.seconds);
  EXPECT_GT(best.error, 1.02);
  // What is proposed can be read again and stays within what the trials did.
  const Experiment again = parse_experiment(best.text, "best", pendulum());
  const double reach =
      (data.trials[0].commands[0].values.array() - data.trials[0].commands[0].values.mean()).abs().maxCoeff();
  EXPECT_LE((again.commands[0].values.array() - again.commands[0].values.mean()).abs().maxCoeff(),
            2.0 * reach);
}

TEST(Suggest, SaysThatABiasAndAPreloadAreOneAnswer) {
  const Data data = trial_with("torque_bias@drive:bias=1e-4");
  const Suggestions found = suggest(pendulum(), effects::Catalogue::all(), data,
                                    {"torque_bias@drive", "preload@shoulder"}, kSilent);
  EXPECT_THAT(found.inseparable,
              testing::ElementsAre(testing::Pair("torque_bias@drive", "preload@shoulder")));
}

TEST(Suggest, RefusesUnknownNames) {
  const Data data = trial_with("torque_bias@drive:bias=1e-4");
  EXPECT_THROW(suggest(pendulum(), effects::Catalogue::all(), data, {"torque_bias@drive"}, kSilent),
               InputError);
  try {
    suggest(pendulum(), effects::Catalogue::all(), data, {"torque_bias@drive", "coulom@drive"}, kSilent);
    FAIL() << "accepted an unknown effect";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("coulomb@drive"));
  }
}

}  // namespace
}  // namespace plumbline::validation
