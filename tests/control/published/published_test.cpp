// What was published, as a file; verdicts.
#include "validation/control/published/published.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "simulator/trace/error.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::validation {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

const std::string kHead =
    "plumbline: published/2\ntitle: test\ngaits:\n  hopping:\n    scenario: " PLUMBLINE_ROOT
    "/robots/mabel/scenarios/hopping.yaml\n";

std::string one(const std::string& middle) {
  return kHead + "    quantities:\n      - name: a thing\n        " + middle + "\n";
}

const char* const kGood =
    "measure: {at_end: q_torso}\n        value: {value: 8, unit: deg, source: here}\n"
    "        tolerance: {value: 2, unit: deg, assumed: because}";

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
  ASSERT_EQ(robot.gaits.size(), 1U);
  const std::vector<PublishedQuantity>& all = robot.gaits[0].quantities;
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].measure.kind, Measure::Kind::at_end);
  EXPECT_EQ(all[0].unit, "rad");
  EXPECT_NEAR(all[0].quantity.value, 8.0 * kDegree, 1e-12);
  EXPECT_EQ(all[0].quantity.unit, "deg");
  EXPECT_NEAR(all[0].tolerance.value, 2.0 * kDegree, 1e-12);
}

TEST(PublishedFile, BadOnesAreRefused) {
  EXPECT_THAT(refusal(one("measure: {at_ende: q_torso}\n        value: {value: 1, unit: deg, source: x}")),
              AllOf(HasSubstr("published.yaml:8"), HasSubstr("did you mean at_end")));
  EXPECT_THAT(refusal(one("measure: {change: travell}\n        value: {value: 1, unit: m, source: x}")),
              HasSubstr("did you mean travel"));
  EXPECT_THAT(refusal(one("measure: {change: travel}\n        value: {value: 1, unit: deg, source: x}\n"
                          "        tolerance: {value: 1, unit: m, source: x}")),
              AllOf(HasSubstr("deg"), HasSubstr("\"m\"")));
  EXPECT_THAT(refusal(one("measure: change\n        value: {value: 1, unit: m, source: x}")),
              HasSubstr("CHANNEL"));
  EXPECT_THAT(refusal(one("measure: duration\n        tolerance: {value: 1, unit: s, source: x}")),
              HasSubstr("one of them"));
  EXPECT_THAT(refusal(one(std::string(kGood) + "\n        at_most: {value: 1, unit: deg, source: x}")),
              HasSubstr("2 of value"));
  EXPECT_THAT(refusal(one(std::string(kGood) + "\n        colour: red")), HasSubstr("colour"));
  EXPECT_THAT(refusal(one(std::string(kGood) + "\n        begins_with: lefft")),
              HasSubstr("did you mean left"));
  EXPECT_THAT(refusal("plumbline: published/1\ntitle: x\ngaits: {}\n"), HasSubstr("published/2"));
  EXPECT_THAT(refusal(kHead), HasSubstr("at least one"));
}

// A curve is a file beside; its unit must fit the channel.
TEST(PublishedFile, HoldsCurvesToo) {
  const test::TemporaryFolder folder;
  folder.write("torso.csv", "share [1],value [deg]\n0,8\n0.5,10\n1,8\n");
  const std::string curve =
      kHead +
      "    curves:\n      - name: torso\n        channel: q_torso\n        file: torso.csv\n"
      "        source: \"a figure\"\n        tolerance: {value: 1, unit: deg, assumed: x}\n";
  const PublishedRobot robot = read_published(folder.write("published.yaml", curve));
  ASSERT_EQ(robot.gaits[0].curves.size(), 1U);
  EXPECT_NEAR(robot.gaits[0].curves[0].value[1], 10.0 * kDegree, 1e-12);
  folder.write("torso.csv", "share [1],value [m]\n0,8\n1,8\n");
  EXPECT_THROW(read_published(folder.path("published.yaml")), InputError);
}

// A cycle of a record over time: rows between its events, a sum of columns, aligned by the event that begins
// it.
TEST(PublishedFile, CutsACycleOutOfARecord) {
  const test::TemporaryFolder folder;
  folder.write("log.csv",
               "t [s],motor [deg],joint [deg],sd [deg]\n1,10,1,1\n1.1,20,2,1\n1.2,30,4,2\n1.3,40,8,2\n");
  const auto curve = [](const std::string& column, const std::string& to) {
    return kHead +
           "    curves:\n      - name: stretch\n        channel: q_torso\n        begins_with: right\n" +
           "        file: log.csv\n        column: " + column +
           "\n        spread: sd\n        cycle: {from: {value: 1.1, unit: s}, to: {value: " + to +
           ", unit: s}}\n        source: here\n        tolerance: {value: 1, unit: deg, assumed: x}\n";
  };
  const PublishedRobot robot =
      read_published(folder.write("published.yaml", curve("{motor: 1, joint: -2}", "1.2")));
  const PublishedCurve& one = robot.gaits[0].curves.at(0);
  ASSERT_EQ(one.at.size(), 2);
  EXPECT_FALSE(one.over_shares);
  EXPECT_EQ(one.foot, 1);
  EXPECT_NEAR(one.at[0], 0.0, 1e-12);
  EXPECT_NEAR(one.at[1], 0.1, 1e-12);
  EXPECT_NEAR(one.value[0], 16.0 * kDegree, 1e-12);
  EXPECT_NEAR(one.value[1], 22.0 * kDegree, 1e-12);
  EXPECT_NEAR(one.spread[1], 2.0 * kDegree, 1e-12);
  folder.write("published.yaml", curve("motr", "1.2"));
  EXPECT_THROW(read_published(folder.path("published.yaml")), InputError);
  folder.write("published.yaml", curve("motor", "1.1"));
  EXPECT_THROW(read_published(folder.path("published.yaml")), InputError);
}

TEST(PublishedFile, TheShippedOneIsWhole) {
  const PublishedRobot robot =
      read_published(PLUMBLINE_ROOT "/robots/mabel/published.yaml", {"hopping", {}, ""});
  ASSERT_EQ(robot.gaits.size(), 1U);
  EXPECT_TRUE(robot.gaits[0].section);
  std::set<std::string> names;
  for (const PublishedQuantity& published : robot.gaits[0].quantities) {
    EXPECT_THAT(published.quantity.source, HasSubstr("Park et al."));
    EXPECT_FALSE(published.quantity.assumed);
    names.insert(published.name);
  }
  EXPECT_EQ(names.size(), 13U);
  EXPECT_EQ(robot.gaits[0].curves.size(), 11U);
}

PublishedQuantity made(PublishedQuantity::Relation relation, double value, double tolerance) {
  PublishedQuantity published;
  published.relation = relation;
  published.quantity.value = value;
  published.tolerance.value = tolerance;
  return published;
}

TEST(Published, SaysHowFarOutside) {
  using Relation = PublishedQuantity::Relation;
  const PublishedQuantity value = made(Relation::value, -0.27, 0.03);
  EXPECT_DOUBLE_EQ(value.outside(-0.25), 0.0);
  EXPECT_NEAR(value.outside(-0.35), -0.05, 1e-12);
  EXPECT_NEAR(value.outside(-0.2), 0.04, 1e-12);
  EXPECT_NEAR(value.deviation(-0.33), -2.0, 1e-12);
  const PublishedQuantity most = made(Relation::at_most, 20.0, 2.0);
  EXPECT_DOUBLE_EQ(most.outside(0.0), 0.0);
  EXPECT_DOUBLE_EQ(most.outside(21.9), 0.0);
  EXPECT_NEAR(most.outside(25.0), 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(most.deviation(-100.0), 0.0);
  const PublishedQuantity least = made(Relation::at_least, 92.0, 0.0);
  EXPECT_DOUBLE_EQ(least.outside(92.0), 0.0);
  EXPECT_DOUBLE_EQ(least.outside(86.0), -6.0);
}

}  // namespace
}  // namespace plumbline::validation
