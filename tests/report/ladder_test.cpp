// The ladder of a page without a diagnosis.
#include <gtest/gtest.h>

#include "tests/identify/predict/hopper.h"
#include "validation/identify/compare/compare.h"
#include "validation/report/report.h"

namespace plumbline::validation {
namespace {

// A height that is recorded 25 mm too high, and a trial that says it may be: the page opens the zero error as
// `compare` does, or its hopper would never touch the ground.
TEST(LineageLadder, ErrorsAreThoseOfCompare) {
  const model::Model model = test::hopper();
  Trial trial = test::hopper_trial(model, "bounce");
  trial.switches.clear();
  trial.contact_events.clear();
  trial.measured.front().values.array() += 0.025;
  trial.measured.front().offset_uncertainty = 0.03;
  const Data data({trial}, {});
  const std::vector<Rung> ladder =
      lineage_ladder(model, model::known_effects(), data, [](const std::string&, double) {});
  EXPECT_DOUBLE_EQ(ladder.back().train(), compare(model, data).scores.train);
  PredictorPool bare(model, data);
  EXPECT_LT(10.0 * ladder.back().train(), estimate_states(bare).scores.train);
}

}  // namespace
}  // namespace plumbline::validation
