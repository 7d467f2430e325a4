// Steps, hops and strides from contact alone.
#include "validation/control/gait/gait.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/control/gait/mabel_hops.h"

namespace plumbline::validation {
namespace {

/// Times (ms) at which a cycle ends, for two feet that are down in the given spans.
using Spans = std::vector<std::pair<int, int>>;
std::vector<int> ends_of(Gait::Cycle cycle, const Spans& left, const Spans& right, int until) {
  Gait gait;
  gait.cycle = cycle;
  gait.feet = {0, 1};
  CycleFinder finder(gait, 2);
  std::vector<int> ends;
  const auto down = [](const Spans& spans, int t) {
    for (const auto& [from, to] : spans) {
      if (t >= from && t < to) {
        return 1e-3;
      }
    }
    return -1e-3;
  };
  for (int t = 0; t < until; ++t) {
    std::vector<model::Touch> touches(2);
    touches[0].depth = down(left, t);
    touches[1].depth = down(right, t);
    if (finder.look(1e-3 * t, touches)) {
      ends.push_back(t);
    }
  }
  return ends;
}

// A hop ends when both feet are down behind a flight of both; a foot that bounces for less than 20 ms, or one
// that never lifts off, makes none.
TEST(CycleFinder, HopsEndWhenAllFeetHaveLanded) {
  const Spans left{{100, 300}, {305, 310}, {500, 700}};
  const Spans right{{110, 320}, {520, 640}, {660, 700}};
  EXPECT_EQ(ends_of(Gait::Cycle::hop, left, right, 900), (std::vector<int>{110, 520}));
}

TEST(CycleFinder, StepsEndAtEachTouchdownAndStridesAtTheFirstFoots) {
  const Spans left{{0, 300}, {500, 505}, {510, 800}, {1000, 1300}};
  const Spans right{{250, 550}, {750, 1050}};
  EXPECT_EQ(ends_of(Gait::Cycle::step, left, right, 1200), (std::vector<int>{0, 250, 500, 750, 1000}));
  EXPECT_EQ(ends_of(Gait::Cycle::stride, left, right, 1200), (std::vector<int>{0, 500, 1000}));
}

TEST(CycleFinder, KnowsWhichFootBeganACycle) {
  Gait gait;
  gait.cycle = Gait::Cycle::step;
  gait.feet = {0, 1};
  CycleFinder finder(gait, 2);
  EXPECT_EQ(finder.foot(), -1);
  std::vector<model::Touch> touches(2);
  const auto down = [&](double left, double right) {
    touches[0].depth = left;
    touches[1].depth = right;
  };
  down(-1e-3, 1e-3);
  EXPECT_TRUE(finder.look(0.0, touches));
  EXPECT_EQ(finder.foot(), 1);
  down(-1e-3, -1e-3);
  EXPECT_FALSE(finder.look(0.3, touches));
  down(1e-3, -1e-3);
  EXPECT_TRUE(finder.look(0.4, touches));
  EXPECT_EQ(finder.foot(), 0);
}

// MABEL's hops by contact are those of the controller's own phases: each landing is where phase II begins.
TEST(GaitRun, HopsByContactAreThoseOfTheControllersPhases) {
  const run::LoadedScenario loaded = hopping(mabel("mabel_planar.yaml"));
  const GaitRun run = hops_of(loaded, 3);
  ASSERT_EQ(run.cycles.size(), 3U) << run.run.end;
  const Eigen::VectorXd& phase = run.run.trace.find("phase")->values;
  std::vector<double> landings;
  bool flown = true;
  for (Eigen::Index k = 1; k < phase.size(); ++k) {
    flown = flown || phase[k] == 6.0;
    if (phase[k] == 2.0 && phase[k - 1] == 1.0 && flown) {
      landings.push_back(1e-3 * static_cast<double>(k));
      flown = false;
    }
  }
  ASSERT_GE(landings.size(), 4U);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(run.cycles[c].begin, landings[c], 1e-9);
    EXPECT_NEAR(run.cycles[c].end, landings[c + 1], 1e-9);
  }
}

}  // namespace
}  // namespace plumbline::validation
