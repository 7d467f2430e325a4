// What candidates promise before any is refitted.
#include "validation/identify/diagnose/screen.h"

#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"
#include "tests/identify/predict/hopper.h"
#include "validation/identify/diagnose/candidates.h"

namespace plumbline::validation {
namespace {

// The hopper's motor alone swings against this cable at 320 Hz: seen from 50 Hz it promises nothing.
TEST(Screen, SeesAStiffCableBetweenALightMotorAndAHeavyLoad) {
  const Data data = hopper_twins("cable_stretch@carriage:stiffness=800,damping=0.02").thinned(4);
  const Stage stage = as_given(test::hopper(), data);
  PredictorPool pool(stage.model, data);
  const std::vector<Candidate> candidates =
      list_candidates(pool, some_laws({"cable_stretch"}), {}, stage.estimate);
  const std::vector<Hypothesis> promises = screen(stage, candidates, data, silent);
  const double left = first_of("cable_stretch@carriage", promises, candidates).promised_train;
  EXPECT_LT(left, 1.2) << "mean square, the floor's is 1; 1.5 from 50 Hz";
}

// A limit that the motion does not reach explains nothing of a stop: it must not promise the error that some
// of the windows happen to have.
TEST(Screen, LawThatDoesNothingPromisesWhatTheModelHas) {
  const Data data = pendulum_twins(
      {"hard_stop@shoulder:cubic_stiffness=1e3,damping=0,root_damping=0,position=0.3,side=1,pulls=0"});
  ASSERT_GT(data.all_windows().size(), 16U) << "some of them are enough to tell";
  const Stage stage = as_given(pendulum_drive(), data);
  PredictorPool pool(stage.model, data);
  const std::vector<Candidate> candidates =
      list_candidates(pool, some_laws({"voltage_limit"}), {}, stage.estimate);
  const std::vector<Hypothesis> promises = screen(stage, candidates, data, silent);
  const double had = stage.estimate.predicted.scores.square();
  EXPECT_NEAR(first_of("voltage_limit@drive", promises, candidates).promised(), had, 0.1 * had);
}

}  // namespace
}  // namespace plumbline::validation
