// A law of more values against a simpler one that it contains.
#include "validation/identify/diagnose/odds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/choose.h"
#include "validation/identify/diagnose/look_ahead.h"

namespace plumbline::validation {
namespace {

/// log_odds of a spring of two stiffnesses against one of one stiffness, on twins with `hidden`.
double odds_of_two(const std::string& hidden) {
  const Data data = pendulum_twins({hidden}).thinned(4);
  const Tried tried = try_candidates(as_given(pendulum_drive(), data),
                                     some_laws({"asymmetric_spring", "spring"}), {}, data, {}, silent);
  return log_odds(tried.stage, first_of("asymmetric_spring@shoulder", tried.refits, tried.candidates),
                  first_of("spring@shoulder", tried.refits, tried.candidates), data);
}

// A spring of two stiffnesses contains one of one: its second value, which the data know to be the first one,
// costs it the odds where both are alike, and wins them where they are not.
TEST(LogOdds, CountAValueThatTheDataKnow) {
  EXPECT_LT(odds_of_two("spring@shoulder:stiffness=0.02,rest=0"), std::log(0.05));
  EXPECT_GT(odds_of_two("asymmetric_spring@shoulder:stiffness_above=0.02,stiffness_below=0.01,rest=0"), 10.0);
}

}  // namespace
}  // namespace plumbline::validation
