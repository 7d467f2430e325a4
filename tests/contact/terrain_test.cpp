#include "contact/terrain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace plumbline::contact {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(double floor, const std::vector<Platform>& platforms) {
  try {
    const Terrain terrain(floor, platforms);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(TerrainTest, IsLevelWithoutPlatforms) {
  for (const double x : {-1e6, 0.0, 3.0}) {
    EXPECT_EQ(Terrain().height_at(x), 0.0);
    EXPECT_EQ(Terrain(-0.2).height_at(x), -0.2);
  }
  EXPECT_TRUE(Terrain().edges().empty());
}

// The step-down of Park et al. (2011): off a platform of 2.5 inch.
TEST(TerrainTest, HasPlatformsInAnyOrder) {
  const Terrain terrain(0.1, {{4.0, 5.0, -0.3}, {-1.0, 2.0, 0.0635}});
  EXPECT_EQ(terrain.height_at(-1.001), 0.1);
  EXPECT_EQ(terrain.height_at(-1.0), 0.0635);  // from belongs to the platform, to does not
  EXPECT_EQ(terrain.height_at(1.999), 0.0635);
  EXPECT_EQ(terrain.height_at(2.0), 0.1);
  EXPECT_EQ(terrain.height_at(3.0), 0.1);
  EXPECT_EQ(terrain.height_at(4.5), -0.3);
  EXPECT_EQ(terrain.height_at(5.0), 0.1);
  EXPECT_THAT(terrain.edges(), ElementsAre(-1.0, 2.0, 4.0, 5.0));
  EXPECT_EQ(terrain.platforms().front().from, -1.0);
}

TEST(TerrainTest, MayClimbStairs) {
  const Terrain stairs(0.0, {{1.0, 2.0, 0.1}, {2.0, 3.0, 0.2}});
  EXPECT_EQ(stairs.height_at(2.0), 0.2);
  EXPECT_THAT(stairs.edges(), ElementsAre(1.0, 2.0, 3.0));
}

TEST(TerrainTest, RefusesWhatIsNoGround) {
  const double nan = std::nan("");
  EXPECT_THAT(refusal(nan, {}), HasSubstr("floor: found a height of nan m"));
  EXPECT_THAT(refusal(0.0, {{1.0, nan, 0.1}}), HasSubstr("from 1 to nan m, height 0.1 m: expected finite"));
  EXPECT_THAT(refusal(0.0, {{nan, 1.0, 0.1}}), HasSubstr("expected finite numbers"));
  EXPECT_THAT(refusal(0.0, {{0.0, 1.0, std::numeric_limits<double>::infinity()}}), HasSubstr("height inf m"));
  EXPECT_THAT(refusal(0.0, {{2.0, 2.0, 0.1}}), HasSubstr("expected it to end after it begins"));
  EXPECT_THAT(refusal(0.0, {{3.0, 2.0, 0.1}}), HasSubstr("expected it to end after it begins"));
  EXPECT_THAT(refusal(0.0, {{1.5, 3.0, 0.2}, {1.0, 2.0, 0.1}}),
              HasSubstr("platform from 1.5 to 3 m, height 0.2 m: overlaps the platform from 1 to 2 m"));
  EXPECT_EQ(refusal(0.0, {{1.0, 2.0, 0.1}, {2.0, 3.0, 0.1}}), "");
}

}  // namespace
}  // namespace plumbline::contact
