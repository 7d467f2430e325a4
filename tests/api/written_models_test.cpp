// What fit and diagnose say of the model that they write is what compare finds of the file, within 1 %.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/api/diagnosing.h"
#include "validation/api/fitting.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::api {
namespace {

struct Robot {
  std::string model, experiments;
  std::vector<std::string> names;
  std::vector<std::string> hidden;  ///< one of them is, with its value
};

const std::vector<Robot>& robots() {
  static const std::vector<Robot> kRobots{
      {"tests/robots/pendulum/model.yaml",
       "tests/robots/pendulum/experiments/",
       {"chirp", "steps", "multisine"},
       {"coulomb@drive:level=0.02", "rotor_inertia@drive:inertia=6e-5", "viscous@drive:damping=2e-4"}},
      {"tests/robots/cart/model.yaml",
       "tests/robots/cart/experiments/",
       {"sines", "pulses", "noise"},
       {"coulomb@belt:level=0.03", "preload@cart:preload=4", "torque_constant_error@belt:scale=0.9"}}};
  return kRobots;
}

Loaded recorded(const Robot& robot, const std::string& hidden) {
  const model::Model bare = model::read_model(robot.model, model::known_effects());
  model::Model truth = bare;
  truth.effects.push_back(validation::parse_effect(hidden, bare, model::known_effects()));
  std::vector<validation::Trial> trials;
  for (const std::string& name : robot.names) {
    trials.push_back(
        validation::twin(truth, validation::read_experiment(robot.experiments + name + ".yaml", bare), {}));
    trials.back().name = trials.back().file = name;
  }
  return load(bare, std::move(trials), 0.5, nullptr);
}

void expect_as_written(const std::string& file, const validation::Scores& said, const Loaded& loaded) {
  const validation::Scores found =
      validation::compare(model::read_model(file, model::known_effects()), *loaded.data).scores;
  EXPECT_NEAR(said.train, found.train, 0.01 * found.train) << file;
  EXPECT_NEAR(said.held_out, found.held_out, 0.01 * found.held_out) << file;
  std::filesystem::remove(file);
}

void silent(const std::string& /*what*/, double /*share*/) {}

// Which values are freed, from where, and what is hidden: drawn.
TEST(WrittenModels, AreWhatFitSays) {
  std::mt19937 random(20261128);
  for (int i = 0; i < 4; ++i) {
    const Robot& robot = robots()[random() % robots().size()];
    const std::string hidden = robot.hidden[random() % robot.hidden.size()];
    const Loaded loaded = recorded(robot, hidden);
    std::vector<std::string> labels;
    for (const validation::FreeParameter& one : validation::free_parameters(loaded.model)) {
      if (random() % 2 == 0) {
        labels.push_back(one.label);
      }
    }
    if (labels.empty()) {
      labels.push_back(validation::free_parameters(loaded.model).front().label);
    }
    validation::FitOptions options;
    options.iterations = 1 + static_cast<int>(random() % 8);  // wherever it is stopped
    const validation::Fit fit = api::fit(loaded, labels, options, silent);
    const std::string file = testing::TempDir() + "written_" + std::to_string(i) + ".yaml";
    save(fit, loaded, file);
    SCOPED_TRACE(robot.model + " with " + hidden);
    expect_as_written(file, fit.after, loaded);
  }
}

TEST(WrittenModels, AreWhatDiagnoseSays) {
  // With the law that is hidden, and without it: then standard identification is the best model found.
  const Robot& robot = robots().front();
  const Loaded loaded = recorded(robot, robot.hidden.front());
  for (const char* known : {"coulomb", "preload"}) {
    const effects::Catalogue one({model::known_effects().find(known)});
    const Answer answer = diagnose(loaded, one, {}, silent);
    const std::string file = testing::TempDir() + "diagnosed.yaml";
    save(answer, loaded.model, file);
    SCOPED_TRACE(known);
    EXPECT_EQ(answer.best.has_value(), std::string(known) == "preload");
    expect_as_written(file, answer.best ? answer.best->fit.scores : answer.diagnosis.ladder.back().scores(),
                      loaded);
  }
}

}  // namespace
}  // namespace plumbline::api
