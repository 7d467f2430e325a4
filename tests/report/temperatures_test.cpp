// Temperatures along a record of two hours: those of the report, and those with which a window begins.
#include "validation/report/temperatures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/predict/windows.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

constexpr double kPeriod = 0.5;         // s
constexpr Eigen::Index kCount = 14400;  // two hours
constexpr double kAmbient = 293.15;     // K
constexpr double kMade = 0.55125;       // K/s of the winding alone: 5000 (0.0525 N m/A 0.2 A)^2

model::Model warming() {
  model::Model model = model::read_model(std::string(PLUMBLINE_ROOT) + "/tests/robots/pendulum/model.yaml",
                                         model::known_effects());
  model.effects.push_back(parse_effect(
      "thermal_motor@drive:copper_sag=1e-3,heating=5000,winding_time=30,housing_time=1500,share=0.1,"
      "copper=0,ambient=293.15",
      model, model::known_effects()));
  return model;
}

/// The arm stands, under 0.2 A; with `rests` ten minutes, and ten minutes none.
Trial standing(bool rests) {
  Trial trial;
  trial.period = kPeriod;
  trial.time = Eigen::VectorXd::LinSpaced(kCount, 0.0, kPeriod * static_cast<double>(kCount - 1));
  Command command;
  command.motor = "drive";
  command.values.resize(kCount);
  for (Eigen::Index k = 0; k < kCount; ++k) {
    command.values[k] = rests && (k / 1200) % 2 == 1 ? 0.0 : (k % 2 == 0 ? 0.2 : -0.2);
  }
  trial.commands = {command};
  Measured measured;
  measured.sensor = "drive";
  measured.values = Eigen::VectorXd::Zero(kCount);
  trial.measured = {measured};
  return trial;
}

/// Winding and housing with which a prediction begins.
Eigen::VectorXd begun(const Trial& trial, Eigen::Index first) {
  Predictor predictor(warming(), trial, {});
  const Window window{0, first, 4};
  predictor.predict(window, predictor.initial_state(window));
  return predictor.predicted_states().col(0).tail(2);
}

// Two thermal masses end share*housing_time times the made heat above the air, and the winding winding_time
// times it above the housing. The slow time constant is 1650 s: exp(-7200/1650) = 1.3 % is left.
TEST(Temperatures, EndWhereHeatLeavesAsFastAsItIsMade) {
  const std::vector<Temperature> all = temperatures(warming(), standing(false));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].state.rfind("winding_temperature of thermal_motor", 0), 0U) << all[0].state;
  EXPECT_EQ(all[1].state.rfind("housing_temperature of thermal_motor", 0), 0U) << all[1].state;
  EXPECT_DOUBLE_EQ(all[0].values[0], kAmbient);
  EXPECT_DOUBLE_EQ(all[1].values[0], kAmbient);
  const double housing = all[1].values[kCount - 1] - kAmbient;
  EXPECT_NEAR(housing, 0.1 * 1500.0 * kMade, 0.02 * 0.1 * 1500.0 * kMade);
  EXPECT_NEAR(all[0].values[kCount - 1] - all[1].values[kCount - 1], 30.0 * kMade, 0.01 * 30.0 * kMade);
}

TEST(Temperatures, ModelWithoutHeatHasNone) {
  const model::Model cold = model::read_model(
      std::string(PLUMBLINE_ROOT) + "/tests/robots/pendulum/model.yaml", model::known_effects());
  EXPECT_TRUE(temperatures(cold, standing(false)).empty());
}

// Half an hour of the past would not do: the housing takes 1500 s. A tenth of a kelvin of 80: what is long
// ago is carried in steps of a second.
TEST(Temperatures, WindowBeginsAsWarmAsTheRecordHasMadeIt) {
  for (const bool rests : {false, true}) {
    const Trial trial = standing(rests);
    const std::vector<Temperature> all = temperatures(warming(), trial);
    for (const Eigen::Index first : {0, 300, 3601, 9001, 13999}) {
      const Eigen::VectorXd start = begun(trial, first);
      EXPECT_NEAR(start[0], all[0].values[first], 0.1) << first;
      EXPECT_NEAR(start[1], all[1].values[first], 0.1) << first;
    }
  }
}

// A log that misses some samples is still that of a warm motor.
TEST(Temperatures, HeatGoesOnThroughAGap) {
  Trial trial = standing(false);
  const Eigen::VectorXd whole = begun(trial, 12000);
  trial.stretches = {{0, 11000}, {11010, kCount}};
  EXPECT_NEAR((begun(trial, 12000) - whole).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace plumbline::validation
