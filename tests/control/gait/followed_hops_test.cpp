// How far models of MABEL can be followed through a recorded hop.
#include <gtest/gtest.h>

#include "tests/control/gait/mabel_hops.h"
#include "validation/identify/predict/initial_states.h"
#include "validation/identify/predict/reach.h"

namespace plumbline::validation {
namespace {

/// Two hops of the model with stretching cables.
Data two_hops(const HopStart& start = {}) {
  return {{recorded_hops(hopping(mabel("mabel_planar.yaml"), start), 2)}, {}};
}

// Without the cables' stretch the motion is lost soon after each window's beginning, and no search over the
// whole of it settles.
TEST(FollowedHops, TheRigidModelFollowsShortSegmentsOnly) {
  const Data data = two_hops();
  const Followed rigid = follow(mabel("mabel_planar_rigid.yaml"), data);
  EXPECT_FALSE(is_whole(rigid));
  EXPECT_LT(rigid.length, 0.1 * data.predict.window);
  EXPECT_GT(rigid.data.windows.size(), 4 * data.windows.size());
  EXPECT_EQ(rigid.x0.size(), rigid.data.windows.size());
}

// In the midst of a stance the encoders hardly tell how deep a foot is in the ground and how hard a pulley is
// in its stop; where the segment before ends tells it.
TEST(FollowedHops, SegmentsInStanceBeginWhereTheOnesBeforeEnd) {
  const Data segments = two_hops({0.04, -0.4, 0.0}).segments(0.03);
  const model::Model machine = mabel("mabel_planar.yaml");
  PredictorPool pool(machine, segments);
  const std::vector<FreeParameter> none;
  InitialStates states(pool, none, {});
  Point measured;
  const std::size_t astray = above_floor(segments, states.settle_all(kRoughly, measured)).size();
  Point in_turn;
  const std::size_t left = above_floor(segments, states.settle_in_turn(kRoughly, in_turn)).size();
  EXPECT_GT(10 * astray, segments.windows.size());
  EXPECT_EQ(left, 0U);
}

// A stance of 0.1 s expands errors thousandfold: over all of it the search ends in a minimum that is not the
// machine's. In which one hangs on the sixth digit of where it begins: it has been 2.3 floors and a hundred.
TEST(FollowedHops, AStanceIsSearchedFromItsBeginning) {
  const Data segments = two_hops().segments(0.1);
  const model::Model machine = mabel("mabel_planar.yaml");
  PredictorPool pool(machine, segments);
  const std::vector<FreeParameter> none;
  const Eigen::VectorXd nothing;
  StateSearch search(pool, 0, none, nothing, nothing);
  Eigen::VectorXd start;
  pool.with(0, none, nothing,
            [&](Predictor& predictor) { start = predictor.search_start(segments.windows[0]); });
  Settled at_once = search.from(start);
  search.settle(kRoughly, at_once);
  EXPECT_TRUE(is_above_floor(segments, 0, at_once.reduced.raw_sse, 2.0));
  EXPECT_FALSE(is_above_floor(segments, 0, search.grown(start, kRoughly).reduced.raw_sse, 1.0));
}

TEST(FollowedHops, SegmentsGrowToWholeWindowsWithTheRightModel) {
  const Data data = two_hops();
  const model::Model machine = mabel("mabel_planar.yaml");
  Followed grown = follow_at(machine, data, 0.03);
  for (int doublings = 0; doublings < 5 && !is_whole(grown); ++doublings) {
    grown = follow_further(machine, data, grown, false);
  }
  EXPECT_TRUE(is_whole(grown));
  EXPECT_LE(not_followed(data, grown), 1U);
}

}  // namespace
}  // namespace plumbline::validation
