// A twin under a sampled controller: what it records is what the controller made of its readings.
#include <gtest/gtest.h>

#include "tests/identify/predict/hopper.h"
#include "validation/identify/closed_loop/controllers.h"

namespace plumbline::validation {
namespace {

TEST(ControlledTwin, RecordsTheCommandsOfTheController) {
  const model::Model model = test::hopper();
  const Trial trial = test::hopper_trial(model, "steps");
  ASSERT_EQ(trial.controllers.size(), 1U);
  ASSERT_EQ(trial.commands.size(), 1U);
  controllers::CascadePd law = law_of(trial.controllers[0], trial.period);
  law.reset(0.0, 0.0);
  const Measured& encoder = trial.measured[1];
  ASSERT_EQ(encoder.sensor, "drive");
  double largest = 0.0;
  for (Eigen::Index k = 0; k < trial.samples(); ++k) {
    const double expected = law.command(trial.controllers[0].reference[k], encoder.values[k]);
    EXPECT_NEAR(trial.commands[0].values[k], expected, 1e-12) << k;
    largest = std::max(largest, std::abs(expected));
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LE(largest, 4.0);
  EXPECT_GT(trial.contact_events.size(), 12U);
}

}  // namespace
}  // namespace plumbline::validation
