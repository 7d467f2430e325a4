// A recipe from file to finding.
#include "tests/studies/recipes/pendulum_recipe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "validation/studies/recipes/linked.h"
#include "validation/studies/recipes/run_recipe.h"
#include "validation/studies/recipes/twins.h"

namespace plumbline::validation {
namespace {

void silent(const std::string& /*what*/, double /*fraction*/) {}

RecipeResult result_for(std::uint64_t seed) {
  const test::TemporaryFolder folder;
  const Recipe recipe =
      read_recipe(folder.write("recipe.yaml", test::pendulum_recipe()), model::known_effects());
  RecipeOptions options;
  options.seed = seed;
  return run_recipe(recipe, options, silent);
}

TEST(PendulumRecipe, FindsATrueValueThatIsNotTheStatedOne) {
  const RecipeResult result = result_for(3);
  const double truth = result.truth.at("friction");
  EXPECT_GT(std::abs(truth - 1e-4), 1e-6);
  ASSERT_EQ(result.steps.size(), 1U);
  ASSERT_EQ(result.steps[0].findings.size(), 1U);
  const IdentifiedValue& found = result.steps[0].findings[0];
  EXPECT_NEAR(found.value, truth, 0.02 * truth);
  EXPECT_NEAR(found.value, truth, 4.0 * found.deviation);  // one seed: four deviations, not two
  EXPECT_LT(found.deviation, 0.02 * truth);
  EXPECT_NEAR(result.steps[0].after, 1.0, 0.1);  // what the encoders alone leave
}

TEST(PendulumRecipe, ASeedRepeatsAndAnotherDiffers) {
  const Truth one = result_for(3).truth;
  EXPECT_EQ(one.at("friction"), result_for(3).truth.at("friction"));
  EXPECT_NE(one.at("friction"), result_for(4).truth.at("friction"));
}

TEST(Truth, StaysWithinTwoDeviationsAndScattersByOne) {
  const test::TemporaryFolder folder;
  const Recipe recipe =
      read_recipe(folder.write("recipe.yaml", test::pendulum_recipe()), model::known_effects());
  double squares = 0.0;
  const int draws = 2000;
  for (int seed = 0; seed < draws; ++seed) {
    const double off = (draw_truth(recipe, static_cast<std::uint64_t>(seed)).at("friction") - 1e-4) / 3e-5;
    EXPECT_LE(std::abs(off), 2.0);
    squares += off * off;
  }
  // A standard normal number cut at two deviations has the variance 1 - 4 phi(2)/(2 Phi(2) - 1) = 0.7737.
  EXPECT_NEAR(squares / draws, 0.7737, 0.06);
}

TEST(Link, GoesThereAndBack) {
  const Link inverse{"", "", 2.0, 0.5, -1, {}};
  EXPECT_DOUBLE_EQ(inverse.parameter(4.0), 1.0);
  EXPECT_DOUBLE_EQ(inverse.unknown_of(1.0), 4.0);
  EXPECT_NEAR(inverse.slope(4.0), (inverse.parameter(4.0 + 1e-6) - inverse.parameter(4.0 - 1e-6)) / 2e-6,
              1e-8);
  const Link straight{"", "", 2.0, 0.5, 1, {}};
  EXPECT_DOUBLE_EQ(straight.parameter(4.0), 8.5);
  EXPECT_DOUBLE_EQ(straight.unknown_of(8.5), 4.0);
}

// What is known beforehand must pull as hard as its deviation says, and no harder.
TEST(PendulumRecipe, AKnownUnknownStaysWithinWhatIsKnown) {
  const test::TemporaryFolder folder;
  std::string text =
      test::with(test::pendulum_recipe(), "  lump:\n",
                 "  mass:\n    title: error of the arm's mass\n    unit: kg\n"
                 "    stated: {value: 0, unit: kg, uncertainty: 1e-9, source: a test}\n  lump:\n");
  text = test::with(text, test::pendulum_robot("model.yaml"), "heavy.yaml");
  text = test::with(text, "    links:\n", "    links:\n      added_mass@arm:mass: mass\n");
  text += "    known: [mass]\n";
  folder.write("heavy.yaml",
               "plumbline: model/1\nbase: " + test::pendulum_robot("model.yaml") +
                   "\nnote: a test\neffects:\n  - effect: added_mass\n    at: arm\n    values:\n"
                   "      mass: {value: 0, unit: kg, assumed: a test}\n");
  const Recipe recipe = read_recipe(folder.write("recipe.yaml", text), model::known_effects());
  RecipeOptions options;
  options.seed = 5;
  const RecipeResult result = run_recipe(recipe, options, silent);
  ASSERT_EQ(result.steps[0].updated.size(), 1U);
  EXPECT_NEAR(result.steps[0].updated[0].value, 0.0, 4e-9);
  EXPECT_LE(result.steps[0].updated[0].deviation, 1.1e-9);
}

}  // namespace
}  // namespace plumbline::validation
