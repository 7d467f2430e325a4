// A law that gives the robot a part which no sensor shows must hold on windows twice as long.
#include "validation/identify/diagnose/longer_windows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/look_ahead.h"

namespace plumbline::validation {
namespace {

/// The pendulum without the encoder of its motor: behind a stretch nobody sees the motor.
model::Model one_encoder() {
  model::Model robot = pendulum_drive();
  robot.sensors.erase(robot.sensors.begin() + robot.sensor_index("drive"));
  return robot;
}

Data one_encoder_twins(const std::string& hidden, double window) {
  Data twins = pendulum_twins({hidden});
  for (Trial& trial : twins.trials) {
    trial.measured.erase(std::remove_if(trial.measured.begin(), trial.measured.end(),
                                        [](const Measured& one) { return one.sensor == "drive"; }),
                         trial.measured.end());
  }
  PredictOptions options;
  options.window = window;
  return Data(twins.trials, options).thinned(8);
}

std::string verdict_on_stretch(const Data& data) {
  const Stage stage = as_given(one_encoder(), data);
  const Tried tried = try_candidates(stage, some_laws({"cable_stretch"}), {}, data, {}, silent);
  const Refit& stretch = first_of("cable_stretch@shoulder", tried.refits, tried.candidates);
  EXPECT_LT(stretch.square(), 0.8 * stage.estimate.predicted.scores.square());
  return short_lived(stage, stretch, data, {});
}

TEST(LongerWindows, KeepAStretchThatIsThere) {
  EXPECT_EQ(verdict_on_stretch(one_encoder_twins("cable_stretch@shoulder:stiffness=0.012,damping=2e-4", 0.1)),
            "");
}

// In a tenth of a second a motor that begins anew makes up for dry friction; in two tenths it does not.
TEST(LongerWindows, RefuseAStretchInThePlaceOfFriction) {
  EXPECT_THAT(verdict_on_stretch(one_encoder_twins("coulomb@drive:level=0.02,smoothing_speed=0.5", 0.1)),
              testing::HasSubstr("short-lived"));
}

// What every sensor sees is not asked.
TEST(LongerWindows, AskOnlyOfWhatNoSensorShows) {
  const Data data = pendulum_twins({"coulomb@drive:level=0.02,smoothing_speed=0.5"}).thinned(4);
  const Stage stage = as_given(pendulum_drive(), data);
  const Tried tried = try_candidates(stage, some_laws({"cable_stretch"}), {}, data, {}, silent);
  EXPECT_EQ(short_lived(stage, first_of("cable_stretch@shoulder", tried.refits, tried.candidates), data, {}),
            "");
}

}  // namespace
}  // namespace plumbline::validation
