// The diagnosis on twins of MABEL's leg on the bench: nothing hidden and one effect hidden.
#include "validation/identify/diagnose/diagnose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"

namespace plumbline::validation {
namespace {

Diagnosis diagnosed(const std::vector<std::string>& hidden) {
  return diagnose(bench(), effects::Catalogue::all(), bench_twins(hidden), {}, silent);
}

TEST(Diagnose, SaysNothingIsMissingOnTheModelsOwnData) {
  const Diagnosis d = diagnosed({});
  EXPECT_EQ(d.verdict, Verdict::nothing_missing);
  EXPECT_TRUE(d.accepted.empty());
  EXPECT_NEAR(d.ladder.back().held_out(), 1.0, 0.05);
}

TEST(Diagnose, NamesAHiddenActuatorLagAndItsValue) {
  const Diagnosis d = diagnosed({"actuator_lag@mLS:time_constant=0.002"});
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.verdict, Verdict::missing);
  EXPECT_EQ(d.accepted[0].effect, "actuator_lag");
  EXPECT_EQ(d.accepted[0].at, "mLS");
  EXPECT_NEAR(d.accepted[0].parameters[0].value, 0.002, 2e-5);
  EXPECT_LT(d.accepted[0].held_out_after, 1.05);
  EXPECT_GT(d.accepted[0].held_out_before, 1.3);
}

// Of one motor each half of it is left, whichever is taken.
TEST(Diagnose, NamesTheDelayOfABusAndNotThatOfOneOfItsMotors) {
  const Diagnosis d = diagnose(bench(), some_laws({"actuator_lag", "bus_delay", "command_delay"}),
                               bench_twins({"bus_delay@world:delay=0.002"}), {}, silent);
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.accepted[0].label(), "bus_delay@world");
  EXPECT_NEAR(d.accepted[0].parameters[0].value, 0.002, 5e-5);
  EXPECT_LT(d.accepted[0].held_out_after, 1.05);
}

}  // namespace
}  // namespace plumbline::validation
