// Runs of a gait that travel between ranks.
#include "validation/control/gait/gait_bytes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::validation {
namespace {

TEST(GaitBytes, ComeBackToTheLastBit) {
  GaitRun run;
  run.run.time = 1.0 / 3.0;
  run.run.fell = true;
  run.run.end = "the torso is below 0.5 m";
  run.run.fault = 7;
  run.run.energy_error = 1e-17;
  run.run.energy_exchanged = 0.1;
  Cycle cycle;
  cycle.begin = 0.1 + 0.2;
  cycle.end = 0.7;
  cycle.foot = -1;
  cycle.values = {0.0, 1.0 / 7.0};
  cycle.curves = {Eigen::Vector2d(0.3, NAN), Eigen::VectorXd()};
  run.cycles = {cycle, Cycle()};
  work::Bytes bytes;
  add(run, bytes);
  work::BytesReader reader(bytes.all());
  const GaitRun back = gait_run_from(reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(back.run.time, run.run.time);
  EXPECT_TRUE(back.run.fell);
  EXPECT_EQ(back.run.end, run.run.end);
  EXPECT_EQ(back.run.fault, 7);
  EXPECT_EQ(back.run.energy_error, 1e-17);
  EXPECT_EQ(back.run.energy_exchanged, 0.1);
  ASSERT_EQ(back.cycles.size(), 2U);
  EXPECT_EQ(back.cycles[0].begin, cycle.begin);
  EXPECT_EQ(back.cycles[0].end, 0.7);
  EXPECT_EQ(back.cycles[0].foot, -1);
  EXPECT_EQ(back.cycles[0].values, cycle.values);
  ASSERT_EQ(back.cycles[0].curves.size(), 2U);
  EXPECT_EQ(back.cycles[0].curves[0][0], 0.3);
  EXPECT_TRUE(std::isnan(back.cycles[0].curves[0][1]));
  EXPECT_EQ(back.cycles[0].curves[1].size(), 0);
  EXPECT_TRUE(back.cycles[1].curves.empty());
}

}  // namespace
}  // namespace plumbline::validation
