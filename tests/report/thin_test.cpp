// Thinning for drawing: nothing that sticks out may be lost.
#include "validation/report/thin.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace plumbline::validation {
namespace {

Eigen::Index points_of(const std::vector<Block>& blocks) {
  Eigen::Index points = 0;
  for (const Block& block : blocks) {
    points += block.points();
  }
  return points;
}

/// Every sample belongs to exactly one block, in order.
void expect_covers(const std::vector<Block>& blocks, Eigen::Index samples) {
  Eigen::Index next = 0;
  for (const Block& block : blocks) {
    EXPECT_EQ(block.first, next);
    EXPECT_GT(block.count, 0);
    next += block.count;
  }
  EXPECT_EQ(next, samples);
}

TEST(DrawingBlocks, CoverTheTrialWithAboutAsManyPointsAsAsked) {
  const std::vector<Block> blocks = drawing_blocks(60000, {}, 4000, 1500);
  expect_covers(blocks, 60000);
  EXPECT_LE(points_of(blocks), 4000 + 2);
  EXPECT_GT(points_of(blocks), 3500);
}

TEST(DrawingBlocks, KeepEverySampleOfASpan) {
  const std::vector<Block> blocks = drawing_blocks(60000, {{30000, 500}, {0, 500}, {59500, 500}}, 4000, 1500);
  expect_covers(blocks, 60000);
  for (const Block& block : blocks) {
    const bool wanted = block.first == 0 || block.first == 30000 || block.first == 59500;
    EXPECT_EQ(block.bucket == 1, wanted) << block.first;
  }
}

TEST(DrawingBlocks, ThinASpanThatIsTooLong) {
  const std::vector<Block> blocks = drawing_blocks(60000, {{10000, 20000}}, 4000, 1500);
  expect_covers(blocks, 60000);
  EXPECT_LE(blocks[1].points(), 1502);
}

TEST(DrawingBlocks, LeaveShortTrialsAsTheyAre) {
  const std::vector<Block> blocks = drawing_blocks(700, {}, 4000, 1500);
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].bucket, 1);
}

TEST(Thinned, KeepsSmallestAndLargestOfEveryStretch) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  Eigen::VectorXd values(10007);
  for (double& value : values) {
    value = noise(random);
  }
  values[4321] = 50.0;  // single samples that a plain decimation would lose
  values[9999] = -70.0;
  const std::vector<Block> blocks = drawing_blocks(values.size(), {}, 500, 100);
  const Eigen::VectorXd points = thinned(values, blocks);
  EXPECT_EQ(points.maxCoeff(), 50.0);
  EXPECT_EQ(points.minCoeff(), -70.0);
  const Eigen::Index bucket = blocks[0].bucket;
  for (Eigen::Index b = 0; 2 * b < points.size(); ++b) {
    const Eigen::Index count = std::min(bucket, values.size() - b * bucket);
    const auto stretch = values.segment(b * bucket, count);
    EXPECT_EQ(std::min(points[2 * b], points[2 * b + 1]), stretch.minCoeff());
    EXPECT_EQ(std::max(points[2 * b], points[2 * b + 1]), stretch.maxCoeff());
  }
}

TEST(Thinned, KeepsTheOrderInWhichExtremesOccur) {
  const Eigen::VectorXd rising = Eigen::VectorXd::LinSpaced(1000, 0.0, 1.0);
  const Eigen::VectorXd points = thinned(rising, drawing_blocks(1000, {}, 100, 10));
  for (Eigen::Index i = 1; i < points.size(); ++i) {
    EXPECT_GE(points[i], points[i - 1]);
  }
}

TEST(Thinned, SeesNothingOnlyWhereThereIsNothing) {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(1000, std::numeric_limits<double>::quiet_NaN());
  values[505] = 2.0;
  const std::vector<Block> blocks = drawing_blocks(1000, {}, 100, 10);
  const Eigen::VectorXd points = thinned(values, blocks);
  const Eigen::Index bucket = 505 / blocks[0].bucket;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    EXPECT_EQ(std::isnan(points[i]), i / 2 != bucket) << i;
  }
  EXPECT_EQ(points[2 * bucket], 2.0);
}

TEST(ThinnedTime, RisesStrictlyAndStaysInsideItsBucket) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(60000, 0.0, 59.999);
  const std::vector<Block> blocks = drawing_blocks(60000, {{30000, 500}}, 4000, 1500);
  const Eigen::VectorXd points = thinned_time(time, blocks);
  ASSERT_EQ(points.size(), points_of(blocks));
  for (Eigen::Index i = 1; i < points.size(); ++i) {
    EXPECT_GT(points[i], points[i - 1]);
  }
  EXPECT_GE(points[0], 0.0);
  EXPECT_LE(points[points.size() - 1], 59.999);
}

}  // namespace
}  // namespace plumbline::validation
