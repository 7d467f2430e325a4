// The error over the prediction horizon, against a motion whose prediction is solved by hand.
#include "validation/identify/compare/horizon.h"

#include <gmock/gmock.h>

#include "tests/identify/closed_loop/slider.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::validation {
namespace {

constexpr double kAcceleration = 0.4;  // m/s^2, that the model knows nothing of
constexpr double kSeconds = 6.0;

/// The slider without friction: a body that no force moves.
model::Model free_body(const std::filesystem::path& folder) {
  model::Model model = slider::read(folder);
  model.effects.clear();
  return model;
}

/// q = a t^2 / 2 at 1 kHz, commands zero.
Trial accelerated() {
  Trial trial;
  trial.name = "accelerated";
  trial.period = slider::kPeriod;
  const auto samples = static_cast<Eigen::Index>(kSeconds / slider::kPeriod);
  trial.time = Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1) * slider::kPeriod);
  trial.measured.push_back({"q", "q", "m", 0.5 * kAcceleration * trial.time.array().square()});
  trial.commands.push_back({"drive", "u", "V", Eigen::VectorXd::Zero(samples)});
  return trial;
}

std::vector<HorizonError> errors_of(const model::Model& model, const Trial& trial, double window) {
  PredictOptions options;
  options.window = window;
  const Data data({trial}, options);
  PredictorPool pool(model, data);
  return horizon_errors(pool, {}, estimate_states(pool));
}

TEST(Horizon, IsTheExtrapolationOfTheBestLine) {
  // The straight line that fits a t^2 / 2 best over a window W is off by a (t^2 - W t + W^2 / 6) / 2 at t.
  const test::TemporaryFolder folder;
  const double window = 0.5;
  const std::vector<HorizonError> errors = errors_of(free_body(folder.path("")), accelerated(), window);
  ASSERT_EQ(errors.size(), 4U);
  for (std::size_t h = 0; h < errors.size(); ++h) {
    const double horizon = usual_horizons()[h];
    const double t = window + horizon;
    const double off = 0.5 * kAcceleration * (t * t - window * t + window * window / 6.0);
    EXPECT_DOUBLE_EQ(errors[h].horizon, horizon);
    EXPECT_EQ(errors[h].unit, "mm");
    EXPECT_EQ(errors[h].lost, 0);
    EXPECT_NEAR(errors[h].rms, 1000.0 * off, 10.0 * off)
        << horizon << " s";  // samples, not a continuous line
  }
  // 12 windows; those in the last 2 s do not reach so far, the last one reaches none.
  EXPECT_EQ(errors[0].windows, 11);
  EXPECT_EQ(errors[3].windows, 8);
}

TEST(Horizon, IsAtTheFloorForTheRightModel) {
  const test::TemporaryFolder folder;
  Trial still = accelerated();
  still.measured[0].values.setConstant(0.25);
  for (const HorizonError& error : errors_of(free_body(folder.path("")), still, 0.5)) {
    EXPECT_LT(error.rms, 1e-3) << error.horizon << " s";  // mm
  }
}

TEST(Horizon, DoesNotReachAcrossAnEvent) {
  const test::TemporaryFolder folder;
  Trial struck = accelerated();
  struck.events = {3.0};
  const std::vector<HorizonError> errors = errors_of(free_body(folder.path("")), struck, 0.5);
  // Windows end at 0.5, 1, ... 6 s; within 0.5 s before 3 s and at the end none counts, for 2 s only those
  // that end by 1 s and by 4 s.
  ASSERT_EQ(errors.size(), 4U);
  EXPECT_EQ(errors[0].windows, 10);
  EXPECT_EQ(errors[3].windows, 4);
}

TEST(Horizon, IsLeftOutWhereNoWindowReachesIt) {
  const test::TemporaryFolder folder;
  Trial brief = accelerated();
  const Eigen::Index samples = 1000;
  brief.time.conservativeResize(samples);
  brief.measured[0].values.conservativeResize(samples);
  brief.commands[0].values.conservativeResize(samples);
  EXPECT_EQ(errors_of(free_body(folder.path("")), brief, 0.5).size(), 3U);  // all but 2 s
}

}  // namespace
}  // namespace plumbline::validation
