// Measures of a cycle, worked out by hand.
#include "validation/control/gait/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/trace/error.h"
#include "tests/control/gait/mabel_hops.h"

namespace plumbline::validation {
namespace {

Measure measure(Measure::Kind kind, std::vector<std::string> channels = {"travel"}) {
  Measure one;
  one.kind = kind;
  one.channels = std::move(channels);
  return one;
}

TEST(Measure, AreWhatTheirNamesSay) {
  const run::LoadedScenario loaded = hopping(mabel("mabel_planar.yaml"));
  const Channels channels(loaded, {"travel", "u_mLA_left", "contact_left"}, {});
  EXPECT_EQ(channels.unit(0), "m");
  EXPECT_EQ(channels.unit(1), "N m");
  Eigen::MatrixXd rows(3, 3);
  rows << 1.0, 9.0, 1.0,  //
      2.0, -4.0, 1.0,     //
      -1.0, 3.0, 0.0;
  const Eigen::Vector3d times(0.0, 0.5, 1.5);
  const Eigen::VectorXd time = times;
  const std::vector<double> touchdowns{1.5, 1.48};
  const CycleSamples cycle{rows, time, touchdowns};
  const auto value = [&](const Measure& one) { return value_of(one, channels, cycle); };
  using Kind = Measure::Kind;
  EXPECT_DOUBLE_EQ(value(measure(Kind::duration)), 1.5);
  EXPECT_DOUBLE_EQ(value(measure(Kind::change)), -2.0);
  EXPECT_DOUBLE_EQ(value(measure(Kind::rate)), -2.0 / 1.5);
  EXPECT_DOUBLE_EQ(value(measure(Kind::at_end)), -1.0);
  EXPECT_DOUBLE_EQ(value(measure(Kind::swing)), 3.0);
  EXPECT_DOUBLE_EQ(value(measure(Kind::integral)), 0.5 * 1.5 + 1.0 * 0.5);
  EXPECT_DOUBLE_EQ(value(measure(Kind::mean)), 1.25 / 1.5);
  EXPECT_NEAR(value(measure(Kind::touchdown_gap)), 0.02, 1e-15);
  EXPECT_DOUBLE_EQ(value(measure(Kind::largest, {"u_mLA_left"})),
                   4.0);  // the first sample is the cycle's before
  Measure limit = measure(Kind::time_at_limit, {"u_mLA_left"});
  limit.limit = 4.0;
  EXPECT_DOUBLE_EQ(value(limit), 0.5);
  EXPECT_DOUBLE_EQ(value(measure(Kind::share_down, {"contact_left"})), 1.0 / 1.5);
  EXPECT_EQ(unit_of(measure(Kind::rate), channels, {}), "m/s");
  EXPECT_DOUBLE_EQ(value(measure(Kind::rms)), std::sqrt(2.5));
  // Only what is above zero counts: 9, 0 and 3.
  EXPECT_DOUBLE_EQ(value(measure(Kind::positive_work, {"u_mLA_left"})), 3.75);
  Measure cost = measure(Kind::cost_of_transport, {"u_mLA_left", "travel"});
  cost.weight = 2.0;
  EXPECT_DOUBLE_EQ(value(cost), 3.75 / (2.0 * 2.0));
}

TEST(Measure, WorkIsOfPowers) {
  const run::LoadedScenario loaded = hopping(mabel("mabel_planar.yaml"));
  const Channels channels(loaded, {"power_mLA_left", "u_mLA_left", "travel"}, {});
  using Kind = Measure::Kind;
  EXPECT_EQ(unit_of(measure(Kind::positive_work, {"power_mLA_left"}), channels, {}), "J");
  EXPECT_EQ(unit_of(measure(Kind::cost_of_transport, {"power_mLA_left", "travel"}), channels, {}), "1");
  EXPECT_THROW(unit_of(measure(Kind::positive_work, {"u_mLA_left"}), channels, {}), InputError);
  EXPECT_THROW(unit_of(measure(Kind::cost_of_transport, {"power_mLA_left", "u_mLA_left"}), channels, {}),
               InputError);
}

// Cycles of unlike length: a mean is taken over those that last so long.
TEST(Cycles, MeanCurvesEndWithTheirCycles) {
  const double none = std::nan("");
  std::vector<GaitRun> runs(1);
  runs[0].cycles.resize(3);
  const std::vector<Eigen::Vector3d> curves{{1.0, 2.0, none}, {3.0, 6.0, none}, {100.0, 100.0, none}};
  for (std::size_t c = 0; c < 3; ++c) {
    runs[0].cycles[c].foot = c < 2 ? 1 : 0;
    runs[0].cycles[c].curves = {curves[c]};
  }
  Gait gait;
  gait.settle = 0;
  EXPECT_EQ(settled_cycles(gait, runs, -1).size(), 3U);
  const MeanCurve mean = mean_curve(settled_cycles(gait, runs, 1), 0);
  EXPECT_DOUBLE_EQ(mean.mean[0], 2.0);
  EXPECT_DOUBLE_EQ(mean.mean[1], 4.0);
  EXPECT_DOUBLE_EQ(mean.deviation[0], std::sqrt(2.0));
  EXPECT_EQ(mean.count[2], 0);
  EXPECT_TRUE(std::isnan(mean.mean[2]));
}

TEST(Measure, SpreadIsMeanAndStandardDeviation) {
  const Spread spread = spread_of({2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0});
  EXPECT_DOUBLE_EQ(spread.mean, 5.0);
  EXPECT_NEAR(spread.deviation, std::sqrt(32.0 / 7.0), 1e-12);
}

TEST(Cycles, SettledOnesLeaveOutTheTransientAndTheFall) {
  const Gait gait;
  std::vector<GaitRun> runs(3);
  runs[0].cycles.resize(20);
  EXPECT_EQ(settled_cycles(gait, {runs[0]}).size(), 15U);
  runs[0].run.fell = true;
  runs[1].cycles.resize(4);
  runs[1].run.fell = true;
  EXPECT_EQ(settled_cycles(gait, runs).size(), 12U);
  const Share share = share_of("x", runs, 10);
  EXPECT_EQ(share.sustained, 1);
  EXPECT_EQ(share.median_cycles, 4.0);
}

}  // namespace
}  // namespace plumbline::validation
