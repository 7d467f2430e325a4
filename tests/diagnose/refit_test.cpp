// Which candidates are refitted, on twins of MABEL's leg on the bench.
#include <gmock/gmock.h>

#include "tests/diagnose/bench.h"
#include "validation/diagnose/look_ahead.h"

namespace plumbline::validation {
namespace {

void silent(const std::string& /*what*/, double /*fraction*/) {}

// A short refit of the cable ends far above the floor, where a backlash could still compete.
TEST(Refit, OfTheOthersIsNotNeededOnceTheBestIsAtTheFloor) {
  const Data data = bench_twins({"cable_stretch@leg_angle:stiffness=3.5,damping=0.0889"}).thinned(24);
  const Tried tried =
      try_candidates(as_given(bench(), data), some_laws({"cable_stretch", "backlash"}), {}, data, {}, silent);
  ASSERT_GE(tried.candidates.size(), 4U);
  ASSERT_EQ(tried.refits.size(), 2U);
  const Refit& best = tried.refits.front();
  EXPECT_EQ(tried.candidates[static_cast<std::size_t>(best.candidate)].label(), "cable_stretch@leg_angle");
  EXPECT_TRUE(best.estimate.converged);
  EXPECT_LT(best.estimate.scores.train, 1.1);
}

}  // namespace
}  // namespace plumbline::validation
