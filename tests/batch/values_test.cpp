// Values of several rows held against each other. Numbers from numpy's least squares and from closed forms.
#include "validation/batch/values.h"

#include <gmock/gmock.h>

#include "validation/batch/batch_page.h"
#include "validation/batch/jobs.h"

namespace plumbline::batch {
namespace {

using nlohmann::json;

/// A fit's row with one parameter.
json row_of(const std::string& robot, const std::string& day, double value, double deviation) {
  const json parameter{{"label", "viscous@drive:damping"},
                       {"unit", "N m s"},
                       {"after", value},
                       {"standard_deviation", deviation},
                       {"interval", {value - 2.0 * deviation, value + 2.0 * deviation}}};
  return {{"label", robot + day},
          {"robot", robot},
          {"day", day},
          {"mode", "fit"},
          {"status", "done"},
          {"errors", {{"train", 1.0}, {"held_out", nullptr}}},
          {"result", {{"parameters", json::array({parameter})}}}};
}

std::vector<json> drifting() {
  return {row_of("A", "0", 1.0, 0.1), row_of("A", "1", 1.2, 0.1), row_of("A", "3", 1.5, 0.2),
          row_of("A", "6", 2.3, 0.1)};
}

TEST(Values, HaveAWeightedMeanAndItsScatter) {
  const std::vector<ValueOverRows> values = values_over(drifting());
  ASSERT_EQ(values.size(), 1U);
  const ValueOverRows& value = values.front();
  EXPECT_EQ(value.name, "viscous@drive:damping");
  // By numpy: chi^2 = 98 about the mean 1.5, between the rows a variance of 0.411666667; t(0.975, 3)
  // = 3.18245.
  EXPECT_NEAR(value.mean, 1.500000000, 1e-8);
  EXPECT_NEAR(value.upper - value.mean, 1.041961719, 1e-7);
  EXPECT_NEAR(value.mean - value.lower, value.upper - value.mean, 1e-12);
  // erfc(sqrt(x/2)) + sqrt(2 x/pi) exp(-x/2) at x = 98
  EXPECT_NEAR(value.probability, 4.183012e-21, 1e-26);
  EXPECT_TRUE(value.differs);
}

TEST(Values, DriftWhereALineOverTheDaysIsSure) {
  const ValueOverRows value = values_over(drifting()).front();
  ASSERT_EQ(value.drifts.size(), 1U);
  const Drift& drift = value.drifts.front();
  EXPECT_EQ(drift.days, 4U);
  EXPECT_NEAR(drift.slope, 0.2166666667, 1e-9);
  EXPECT_NEAR(drift.deviation, 0.0219426863, 1e-9);  // the scatter, chi^2/2 = 0.25, is below the deviations
  EXPECT_NEAR(drift.limit, 1.959964 * drift.deviation, 1e-6);
  EXPECT_TRUE(drift.drifts());
}

TEST(Values, DoNotDriftWithinTheirDeviations) {
  std::vector<json> rows = drifting();
  for (json& row : rows) {
    row["result"]["parameters"][0]["standard_deviation"] = 2.0;
  }
  const ValueOverRows value = values_over(rows).front();
  EXPECT_FALSE(value.drifts.front().drifts());
  EXPECT_FALSE(value.differs);
  EXPECT_NEAR(value.upper - value.mean, 1.959964, 1e-5);  // 2/sqrt(4): the deviations, not the scatter
}

// A line through three points without deviations has one degree of freedom: the limit is Student's, 12.7.
TEST(Values, WithoutDeviationsDriftByTheirScatter) {
  std::vector<json> rows{row_of("A", "0", 0.0, 0.0), row_of("A", "1", 1.0, 0.0), row_of("A", "2", 2.3, 0.0)};
  const Drift close = values_over(rows).front().drifts.front();
  EXPECT_NEAR(close.slope, 1.15, 1e-12);
  EXPECT_NEAR(close.limit / close.deviation, 12.7062, 1e-4);
  EXPECT_TRUE(close.drifts());
  rows[1]["result"]["parameters"][0]["after"] = 2.0;
  EXPECT_FALSE(values_over(rows).front().drifts.front().drifts());
}

// Eight robots that stand still: the 5 % are shared, and each line is held against 1 - 0.05/8.
TEST(Values, ShareTheFalseAlarms) {
  std::vector<json> rows;
  for (int robot = 0; robot < 8; ++robot) {
    rows.push_back(row_of(std::to_string(robot), "0", 1.0, 0.1));
    rows.push_back(row_of(std::to_string(robot), "1", 1.0, 0.1));
  }
  const ValueOverRows value = values_over(rows).front();
  ASSERT_EQ(value.drifts.size(), 8U);
  EXPECT_NEAR(value.drifts.front().limit / value.drifts.front().deviation, 2.7344, 1e-3);
}

TEST(Effects, AreCountedWhereNamedAndWhereRivals) {
  json named = row_of("A", "", 0.0, 0.0);
  named["mode"] = "diagnose";
  named["result"] = json::parse(R"({"accepted": [{"effect": "coulomb", "at": "drive", "parameters": [],
      "rivals": [{"effect": "lugre", "at": "drive"}]}]})");
  json other = named;
  other["result"]["accepted"][0]["effect"] = "lugre";
  other["result"]["accepted"][0]["rivals"] = json::array();
  json failed = named;
  failed["status"] = "failed";
  const std::vector<EffectOverRows> effects = effects_over({other, named, failed, named});
  ASSERT_EQ(effects.size(), 2U);
  EXPECT_EQ(effects[0].label(), "coulomb@drive");
  EXPECT_EQ(effects[0].named, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(effects[1].named, (std::vector<std::size_t>{0}));
  EXPECT_EQ(effects[1].rival, (std::vector<std::size_t>{1, 3}));
}

TEST(Page, EscapesWhatFilesSay) {
  json row = row_of("<b>", "", 1.0, 0.1);
  row["status"] = "failed";
  row["why"] = "a \"<script>\", and more";
  const std::string page = page_of("Tom & <Jerry>", {row});
  EXPECT_EQ(page.find("<script>"), std::string::npos);
  EXPECT_NE(page.find("Tom &amp; &lt;Jerry&gt;"), std::string::npos);
  EXPECT_NE(page.find("1 failed"), std::string::npos);
  EXPECT_NE(csv_of({row}).find(",failed,\"a \"\"<script>\"\", and more\","), std::string::npos);
}

TEST(Days, AreCountedFrom1970) {
  EXPECT_EQ(days_of("1970-01-01"), 0.0);
  EXPECT_EQ(days_of("1969-12-31"), -1.0);
  EXPECT_EQ(days_of("2000-03-01"), 11017.0);
  EXPECT_EQ(days_of("2024-02-29"), 19782.0);
  EXPECT_EQ(days_of("2026-03-14"), 20526.0);
  for (const char* wrong : {"2023-02-29", "2026-13-01", "2026-3-1", "2026-04-31", "14.3.2026", ""}) {
    EXPECT_FALSE(days_of(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace plumbline::batch
