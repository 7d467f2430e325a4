#include "validation/studies/recipes/untold.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline::validation {
namespace {

Unknown stated(const std::string& name, double value, double deviation) {
  Unknown unknown;
  unknown.name = name;
  unknown.value = value;
  unknown.deviation = deviation;
  return unknown;
}

IdentifiedValue found(const std::string& name, double value, double half_width, bool seen = true) {
  return {name, value, 0.5 * half_width, value - half_width, value + half_width, seen};
}

TEST(Untold, NamesWideIntervalsAndWhatTheyTradeWith) {
  Recipe recipe;
  recipe.unknowns = {stated("sure", 10.0, 1.0), stated("wide", 10.0, 1.0), stated("near_zero", 0.1, 4.0),
                     stated("unseen", 10.0, 1.0), stated("with_target", 10.0, 1.0)};
  recipe.unknowns.back().target = Target{1.0, false};
  StepResult result;
  result.findings = {found("sure", 10.0, 2.4), found("wide", 10.0, 2.6), found("near_zero", 0.1, 0.9),
                     found("unseen", 10.0, 0.0, false), found("with_target", 10.0, 9.0)};
  result.correlations = {{"sure", "with_target", 0.99}, {"wide", "sure", -0.98}};

  const std::vector<Untold> list = untold(recipe, result);

  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].unknown, "wide");
  EXPECT_NEAR(list[0].width, 0.52, 1e-12);
  EXPECT_EQ(list[0].strongest.other, "sure");
  EXPECT_EQ(list[1].unknown, "unseen");
  EXPECT_EQ(list[1].width, std::numeric_limits<double>::infinity());
  EXPECT_EQ(list[1].strongest.one, "");
}

}  // namespace
}  // namespace plumbline::validation
