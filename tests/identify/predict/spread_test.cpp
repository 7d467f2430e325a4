// A window's normal equations as they travel between ranks: the same doubles on the other side.
#include "validation/identify/predict/spread.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline::validation {
namespace {

Reduced some() {
  Reduced one;
  one.H = Eigen::MatrixXd::Random(3, 3);
  one.g = Eigen::VectorXd::Random(3);
  one.sse = 0.1;
  one.raw_sse = std::numeric_limits<double>::infinity();
  one.curved = true;
  one.expansion = 1e-300;
  one.square = Eigen::VectorXd::Random(2);
  one.x_shift = Eigen::VectorXd::Random(4);
  one.x_slope = Eigen::MatrixXd::Random(4, 3);
  one.x_H = Eigen::MatrixXd::Random(4, 4);
  one.channel_slopes = Eigen::MatrixXd::Random(3, 2);
  return one;
}

void expect_same(const Reduced& one, const Reduced& other) {
  EXPECT_EQ(one.H, other.H);
  EXPECT_EQ(one.g, other.g);
  EXPECT_EQ(one.sse, other.sse);
  EXPECT_EQ(one.raw_sse, other.raw_sse);
  EXPECT_EQ(one.curved, other.curved);
  EXPECT_EQ(one.expansion, other.expansion);
  EXPECT_EQ(one.square, other.square);
  EXPECT_EQ(one.x_shift, other.x_shift);
  EXPECT_EQ(one.x_slope, other.x_slope);
  EXPECT_EQ(one.x_H, other.x_H);
  EXPECT_EQ(one.channel_slopes, other.channel_slopes);
}

TEST(Spread, NormalEquationsTravelWhole) {
  const Reduced first = some();
  Reduced bare = some();  // without parameters: matrices without columns or rows
  bare.H.resize(0, 0);
  bare.g.resize(0);
  bare.x_slope = Eigen::MatrixXd(4, 0);
  bare.channel_slopes.resize(0, 0);
  Record record;
  add(first, record);
  add(bare, record);
  RecordReader reader(record);
  expect_same(reduced_from(reader), first);
  expect_same(reduced_from(reader), bare);
  EXPECT_THROW(reader.number(), std::out_of_range);
}

}  // namespace
}  // namespace plumbline::validation
