// What the diagnosis of an earlier version got wrong on data that it had no part in, each as a test: twins of
// the foreign world (worlds/), with nothing scattered. All are : none has been run on the present
// version, so that none is known to pass, and each takes half a minute of processor or more. Run them one at
// a time:
//   test_battery_blind --gtest_also_run_disabled_tests --gtest_filter='*Coulomb*'
// One that passes loses the prefix.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/battery/worlds/lab.h"
#include "tests/battery/worlds/recorder.h"
#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/fit/fit.h"
#include "validation/report/sentences.h"

namespace plumbline::battery::worlds {
namespace {

using validation::Diagnosis;
using validation::Finding;
using validation::Verdict;

std::string in_root(const std::string& file) { return std::string(PLUMBLINE_ROOT) + "/" + file; }

struct Robot {
  std::string name, model;
  std::vector<std::string> experiments;
};

const Robot& pendulum() {
  static const Robot kPendulum{
      "pendulum",
      "tests/robots/pendulum/model.yaml",
      {"tests/robots/pendulum/experiments/chirp.yaml", "tests/robots/pendulum/experiments/steps.yaml",
       "tests/robots/pendulum/experiments/multisine.yaml"}};
  return kPendulum;
}

const Robot& hopper() {
  static const Robot kHopper{
      "hopper",
      "robots/hopper/hopper.yaml",
      {"robots/hopper/experiments/bounce.yaml", "robots/hopper/experiments/steps.yaml"}};
  return kHopper;
}

const Robot& leg() {
  static const Robot kLeg{"leg_bench",
                          "robots/mabel/leg_bench.yaml",
                          {"robots/mabel/experiments/siso_mLA.yaml", "robots/mabel/experiments/siso_mLS.yaml",
                           "robots/mabel/experiments/mimo.yaml"}};
  return kLeg;
}

model::Model model_of(const Robot& robot) {
  return model::read_model(in_root(robot.model), model::known_effects());
}

/// `change`: what else is done to the rig.
validation::Data recorded(const Robot& robot, const std::vector<std::string>& hidden,
                          const std::function<void(Rig&)>& change = nullptr) {
  const model::Model model = model_of(robot);
  Rig rig = rig_of(robot.name, model);
  for (const std::string& text : hidden) {
    hide(hidden_from(text), rig);
  }
  if (change) {
    change(rig);
  }
  std::mt19937_64 noise(1);
  std::vector<validation::Trial> trials;
  for (const std::string& file : robot.experiments) {
    const validation::Experiment experiment = validation::read_experiment(in_root(file), model);
    trials.push_back(trial_of(record(rig, experiment, model), experiment, model, noise));
    trials.back().name = trials.back().file = file;
  }
  return validation::Data(std::move(trials), {});
}

Diagnosis diagnosed(const model::Model& model, const validation::Data& data) {
  return validation::diagnose(model, model::known_effects(), data, {}, [](const std::string&, double) {});
}

Diagnosis diagnosed(const Robot& robot, const validation::Data& data) {
  return diagnosed(model_of(robot), data);
}

Diagnosis diagnosed(const Robot& robot, const std::vector<std::string>& hidden) {
  return diagnosed(robot, recorded(robot, hidden));
}

/// "coulomb@drive cable_stretch@shoulder", in the order in which they were accepted.
std::string names(const Diagnosis& diagnosis) {
  std::string all;
  for (const Finding& finding : diagnosis.accepted) {
    all += (all.empty() ? "" : " ") + finding.label();
  }
  return all;
}

TEST(Blind, CoulombFrictionIsNotCalledStribeck) {
  const Diagnosis found = diagnosed(pendulum(), {"coulomb@drive:level=1.6e-4,smoothing_speed=0.1"});
  EXPECT_EQ(found.verdict, Verdict::missing) << validation::summary(found);
  EXPECT_EQ(names(found), "coulomb@drive") << validation::summary(found);
}

TEST(Blind, StrongCoggingOnTheGridIsNamed) {
  const Diagnosis found = diagnosed(pendulum(), {"cogging@drive:sine=8e-3,cosine=6e-3,cycles=12"});
  EXPECT_EQ(names(found), "cogging@drive") << validation::summary(found);
}

TEST(Blind, CoggingOfAnUnusualCountIsNamed) {
  const Diagnosis found = diagnosed(pendulum(), {"cogging@drive:sine=2e-3,cosine=1.5e-3,cycles=11"});
  ASSERT_EQ(names(found), "cogging@drive") << validation::summary(found);
  const auto& values = found.accepted.front().parameters;
  const auto cycles =
      std::find_if(values.begin(), values.end(), [](const auto& one) { return one.name == "cycles"; });
  ASSERT_NE(cycles, values.end());
  EXPECT_EQ(cycles->value, 11.0);
}

// The foreign world's load is the torque that the gear passes on.
TEST(Blind, FrictionThatFollowsWhatTheGearPassesOnIsGearFriction) {
  const Diagnosis found =
      diagnosed(pendulum(), {"load_friction@drive:coefficient=3.5e-3,smoothing_speed=0.1"});
  EXPECT_EQ(names(found), "gear_friction@drive") << validation::summary(found);
}

TEST(Blind, NothingHiddenNamesNothing) {
  for (const Robot* robot : {&pendulum(), &leg()}) {
    const Diagnosis found = diagnosed(*robot, std::vector<std::string>());
    EXPECT_EQ(found.verdict, Verdict::nothing_missing) << validation::summary(found);
    EXPECT_EQ(names(found), "");
  }
}

// What is stated with its tolerance moves within it, and is no effect.
TEST(Blind, ConstantsOfWhichTheToleranceIsStatedAreNotNamed) {
  const validation::Data data = recorded(pendulum(), {}, [](Rig& rig) {
    rig.motor("drive")->ratio *= 1.0 + 5e-4;
    rig.body("arm").along += 5e-4;
  });
  const Diagnosis found = diagnosed(with_tolerances(model_of(pendulum())), data);
  EXPECT_EQ(found.verdict, Verdict::nothing_missing) << validation::summary(found);
  EXPECT_EQ(names(found), "") << validation::summary(found);
  EXPECT_GT(found.ladder.front().held_out(), 1.2);  // else nothing was off
}

TEST(Blind, StopInsideTheHoppersRangeIsLookedFor) {
  const Diagnosis found = diagnosed(
      hopper(),
      {"hard_stop@height:cubic_stiffness=2.4e5,damping=2,root_damping=0.3,position=0.44,side=1,pulls=0"});
  EXPECT_GT(found.candidates, 0) << validation::summary(found);
  EXPECT_THAT(names(found), testing::HasSubstr("hard_stop@height")) << validation::summary(found);
}

// A switch that closes at 2 N. Where the model says so nothing is missing; where it does not, no more than
// the switch is.
TEST(Blind, ASwitchWithAThresholdInventsNothing) {
  const validation::Data data = recorded(hopper(), {}, [](Rig& rig) { rig.switch_force = 2.0; });
  model::Model stated = model_of(hopper());
  stated.switches.front().threshold = 2.0;
  const Diagnosis null =
      validation::diagnose(stated, model::known_effects(), data, {}, [](const std::string&, double) {});
  EXPECT_EQ(names(null), "") << validation::summary(null);
  EXPECT_EQ(null.verdict, Verdict::nothing_missing) << validation::summary(null);
  const Diagnosis found = diagnosed(hopper(), data);
  EXPECT_EQ(names(found), "switch_lateness@toe_switch") << validation::summary(found);
}

// Numbers that are off by two deviations: the headline says so.
TEST(Blind, NumbersThatMovedAreInTheHeadline) {
  const Diagnosis found = diagnosed(pendulum(), recorded(pendulum(), {}, [](Rig& rig) {
                                      rig.body("arm").mass *= 1.044;
                                      rig.body("arm").central *= 1.044;
                                      rig.motor("drive")->torque_per_unit *= 0.9;
                                    }));
  EXPECT_EQ(found.verdict, Verdict::nothing_missing) << validation::summary(found);
  EXPECT_THAT(validation::summary(found), testing::HasSubstr("torque_constant_error@drive:scale by -"));
}

// An estimate never ends worse than it began, on the trials that it is fitted to.
TEST(Blind, AFitOfTheGroundsHeightMakesNothingWorse) {
  validation::Data data = recorded(hopper(), {"coulomb@height:level=0.21,smoothing_speed=0.003"});
  for (validation::Trial& trial : data.trials) {
    trial.switches.clear();
    trial.contact_events.clear();
  }
  data = validation::Data(data.trials, {});
  model::Model model = model_of(hopper());
  model.effects.push_back(
      {model::known_effects().find("ground_height_error"), "toe", {model::Quantity()}, 0});
  const validation::Fit fitted = validation::fit(
      model, data,
      validation::matching(validation::free_parameters(model), {"ground_height_error@toe:height"}), {},
      [](const std::string&, double) {});
  EXPECT_LE(fitted.after.train, 1.01 * fitted.before.train);
}

}  // namespace
}  // namespace plumbline::battery::worlds
