// What speaks against a refit: a value that cannot be told from no effect.
#include "validation/identify/diagnose/objection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/look_ahead.h"
#include "validation/identify/diagnose/own_parameters.h"
#include "validation/identify/predict/deviations.h"

namespace plumbline::validation {
namespace {

double stiffness_in_deviations(const Refit& refit, const Data& data) {
  PredictorPool pool(refit.extended.model, data);
  Estimate at = refit.estimate;
  at.theta = at.predicted.theta;
  const Precision precision = precision_of(pool, data.all_windows(), refit.extended.parameters, at);
  const Eigen::Index stiffness = at.theta.size() - 2;
  return at.theta[stiffness] / precision.deviations[stiffness];
}

// Beside the leg's own spring, whose stiffness is uncertain, a further one is little more than its force at
// its rest: by deviations its stiffness could be nothing. But the rest that would then give that force is out
// of reach, and without the spring the error is large.
TEST(Objection, AStiffnessThatTradesWithItsRestIsNotNothing) {
  const Data data = bench_twins({"spring@leg_shape:stiffness=0.58,rest=0.284"}).thinned(8);
  const Stage stage = fitted_anew(with_open_numbers(as_given(bench(), data), 0, 3.0, data), data);
  const Tried tried = try_candidates(stage, some_laws({"spring"}), {}, data, {}, silent);
  const Refit& hidden = first_of("spring@leg_shape", tried.refits, tried.candidates);
  ASSERT_GT(stage.estimate.predicted.scores.square(), 3.0 * hidden.square());
  ASSERT_LT(stiffness_in_deviations(hidden, data), 2.0);
  EXPECT_EQ(flaw(hidden, data, {}), "");
  // What is as good without it is still refused.
  const Refit& elsewhere = first_of("spring@shin", tried.refits, tried.candidates);
  EXPECT_THAT(flaw(elsewhere, data, {}), testing::HasSubstr("stiffness cannot be told from no effect"));
}

}  // namespace
}  // namespace plumbline::validation
