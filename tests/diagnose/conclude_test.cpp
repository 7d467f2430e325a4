// What is said where a diagnosis ends.
#include <gtest/gtest.h>

#include "tests/diagnose/bench.h"
#include "validation/diagnose/finish.h"

namespace plumbline::validation {
namespace {

// The first rung is of short segments of the windows on which nothing was missing, the last of all that could
// be followed.
TEST(Conclude, WhereNothingWasAddedTheLastErrorCounts) {
  const Data data = bench_twins({"coulomb@mLA:level=0.02"}).thinned(2);
  Diagnosis diagnosis;
  Rung rung{"as given", as_given(bench(), data), 0.2};
  rung.stage.estimate.predicted.scores.held_out = 0.95;
  diagnosis.ladder.push_back(rung);
  rung.length = 0.5;
  rung.stage.estimate.predicted.scores.held_out = 2.6;
  diagnosis.ladder.push_back(rung);
  diagnosis.final_stage = rung.stage;

  conclude(data, {}, diagnosis);
  EXPECT_EQ(diagnosis.verdict, Verdict::unexplained);
  EXPECT_EQ(diagnosis.unexplained_share, 1.0);

  diagnosis.final_stage.estimate.predicted.scores.held_out = 1.0;
  conclude(data, {}, diagnosis);
  EXPECT_EQ(diagnosis.verdict, Verdict::nothing_missing);
  EXPECT_EQ(diagnosis.unexplained_share, 0.0);
}

}  // namespace
}  // namespace plumbline::validation
