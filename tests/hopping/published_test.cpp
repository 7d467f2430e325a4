// What was published, as a file; what is measured of a run; verdicts.
#include "validation/hopping/published.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "simulator/trace/error.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::validation {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::string one(const std::string& middle) {
  return "plumbline: published/1\nmodel: m.yaml\ncontroller: c.yaml\nquantities:\n  - name: a thing\n    " +
         middle + "\n";
}

const char* const kGood =
    "measure: torso_at_landing\n    value: {value: 8, unit: deg, source: here}\n"
    "    tolerance: {value: 2, unit: deg, assumed: because}";

PublishedRobot read(const std::string& text) {
  const test::TemporaryFolder folder;
  return read_published(folder.write("published.yaml", text));
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PublishedFile, IsReadInSi) {
  const PublishedRobot robot = read(one(kGood));
  EXPECT_THAT(robot.model, testing::EndsWith("/m.yaml"));
  EXPECT_THAT(robot.controller, testing::EndsWith("/c.yaml"));
  EXPECT_EQ(robot.tuned_rigid, "");
  const std::vector<Published>& all = robot.quantities;
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].measure->name, "torso_at_landing");
  EXPECT_NEAR(all[0].quantity.value, 8.0 * kDegree, 1e-12);
  EXPECT_EQ(all[0].quantity.unit, "deg");
  EXPECT_NEAR(all[0].tolerance.value, 2.0 * kDegree, 1e-12);
}

TEST(PublishedFile, BadOnesAreRefused) {
  EXPECT_THAT(refusal(one("measure: torso_at_landin\n    value: {value: 1, unit: deg, source: x}")),
              AllOf(HasSubstr("published.yaml:6"), HasSubstr("torso_at_landing")));
  EXPECT_THAT(refusal(one("measure: travel\n    value: {value: 1, unit: deg, source: x}\n"
                          "    tolerance: {value: 1, unit: m, source: x}")),
              AllOf(HasSubstr("deg"), HasSubstr("\"m\"")));
  EXPECT_THAT(refusal(one("measure: travel\n    tolerance: {value: 1, unit: m, source: x}")),
              HasSubstr("one of them"));
  EXPECT_THAT(refusal(one(std::string(kGood) + "\n    at_most: {value: 1, unit: deg, source: x}")),
              HasSubstr("2 of value"));
  EXPECT_THAT(refusal(one("measure: travel\n    value: {value: 1, unit: m, source: x}\n"
                          "    tolerance: {value: -1, unit: m, source: x}")),
              HasSubstr("tolerance"));
  EXPECT_THAT(refusal(one("measure: travel\n    value: {value: 1, unit: m}\n"
                          "    tolerance: {value: 1, unit: m, source: x}")),
              HasSubstr("source"));
  EXPECT_THAT(refusal(one(std::string(kGood) + "\n    colour: red")), HasSubstr("colour"));
  EXPECT_THAT(refusal("plumbline: published/1\ncontroller: c.yaml\nquantities: []\n"), HasSubstr("model"));
  EXPECT_THAT(refusal("plumbline: published/2\nquantities: []\n"), HasSubstr("published/1"));
  EXPECT_THAT(refusal("plumbline: published/1\nmodel: m\ncontroller: c\nquantities: []\n"),
              HasSubstr("at least one"));
}

TEST(PublishedFile, TheShippedOneIsWhole) {
  const PublishedRobot robot = read_published(PLUMBLINE_ROOT "/robots/mabel/published.yaml");
  const std::vector<Published>& all = robot.quantities;
  EXPECT_TRUE(std::filesystem::exists(robot.model) && std::filesystem::exists(robot.controller));
  std::set<std::string> names;
  for (const Published& published : all) {
    EXPECT_THAT(published.quantity.source, HasSubstr("Park et al."));
    EXPECT_FALSE(published.quantity.assumed);
    names.insert(published.measure->name);
  }
  EXPECT_EQ(names.size(), all.size());  // each measure once
  EXPECT_THAT(names, testing::IsSupersetOf({"hops", "travel", "tower_turn", "torso_at_landing",
                                            "touchdown_gap", "stretch", "growth", "growth_without_update"}));
}

Published made(Published::Relation relation, double value, double tolerance) {
  Published published;
  published.relation = relation;
  published.quantity.value = value;
  published.tolerance.value = tolerance;
  return published;
}

TEST(Published, SaysHowFarOutside) {
  const Published value = made(Published::Relation::value, -0.27, 0.03);
  EXPECT_DOUBLE_EQ(value.outside(-0.25), 0.0);
  EXPECT_NEAR(value.outside(-0.35), -0.05, 1e-12);
  EXPECT_NEAR(value.outside(-0.2), 0.04, 1e-12);
  EXPECT_NEAR(value.deviation(-0.33), -2.0, 1e-12);
  const Published most = made(Published::Relation::at_most, 20.0, 2.0);
  EXPECT_DOUBLE_EQ(most.outside(0.0), 0.0);
  EXPECT_DOUBLE_EQ(most.outside(21.9), 0.0);
  EXPECT_NEAR(most.outside(25.0), 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(most.deviation(-100.0), 0.0);
  const Published least = made(Published::Relation::at_least, 92.0, 0.0);
  EXPECT_DOUBLE_EQ(least.outside(92.0), 0.0);
  EXPECT_DOUBLE_EQ(least.outside(200.0), 0.0);
  EXPECT_DOUBLE_EQ(least.outside(86.0), -6.0);
}

HopRun run_of(int hops, bool fell) {
  HopRun run;
  run.fell = fell;
  for (int h = 0; h < hops; ++h) {
    Hop hop;
    hop.travel = -0.01 * h;
    hop.largest_stretch_LA = 1.0;
    hop.largest_stretch_LS = 3.0;
    run.hops.push_back(hop);
  }
  return run;
}

TEST(Measures, SettledHopsLeaveOutTheTransientAndTheFall) {
  EXPECT_EQ(settled_hops({run_of(20, false)}).size(), 15U);
  EXPECT_EQ(settled_hops({run_of(20, true)}).size(), 12U);
  EXPECT_EQ(settled_hops({run_of(20, true), run_of(4, true), run_of(0, true)}).size(), 12U);
  EXPECT_DOUBLE_EQ(settled_hops({run_of(20, false)}).front().travel, -0.05);
}

TEST(Measures, EveryMeasureOfAHopIsMeasured) {
  controllers::HoppingConfig config;
  config.boom_length = 2.25;
  Hop hop;
  hop.travel = -0.27;
  hop.largest_stretch_LA = 1.0;
  hop.largest_stretch_LS = 3.0;
  for (const Measure& measure : measures()) {
    if (measure.kind == Measure::Kind::of_a_hop) {
      EXPECT_NO_THROW(measure_of(measure, hop, config)) << measure.name;
    } else {
      EXPECT_THROW(measure_of(measure, hop, config), std::invalid_argument) << measure.name;
    }
  }
  EXPECT_DOUBLE_EQ(measure_of(*find_measure("tower_turn"), hop, config), -0.12);
  EXPECT_DOUBLE_EQ(measure_of(*find_measure("stretch"), hop, config), 3.0);
  EXPECT_EQ(find_measure("no such thing"), nullptr);
}

TEST(Measures, SpreadIsMeanAndStandardDeviation) {
  const Spread spread = spread_of({2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0});
  EXPECT_DOUBLE_EQ(spread.mean, 5.0);
  EXPECT_NEAR(spread.deviation, std::sqrt(32.0 / 7.0), 1e-12);
  EXPECT_EQ(spread.count, 8);
}

}  // namespace
}  // namespace plumbline::validation
