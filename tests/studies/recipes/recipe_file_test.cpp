// What a recipe may not say.
#include <gmock/gmock.h>

#include "simulator/model/known_effects.h"
#include "tests/studies/recipes/pendulum_recipe.h"
#include "tests/trace/refusal.h"
#include "validation/studies/recipes/run_recipe.h"

namespace plumbline::validation {
namespace {

using testing::HasSubstr;

struct Bad {
  std::string name, what, by;
  std::vector<std::string> message;
};

void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }

class BadRecipes : public testing::TestWithParam<Bad> {};

TEST_P(BadRecipes, AreRefusedInOneLine) {
  const test::TemporaryFolder folder;
  const std::string file =
      folder.write("recipe.yaml", test::with(test::pendulum_recipe(), GetParam().what, GetParam().by));
  const std::string text = test::refusal([&] { read_recipe(file, model::known_effects()); });
  EXPECT_THAT(text, HasSubstr("recipe.yaml:"));
  for (const std::string& part : GetParam().message) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadRecipes,
    testing::Values(
        Bad{"key", "    free:", "    freee: []\n    free:", {"freee", "free"}},
        Bad{"top_key", "title: A pendulum", "titel: A pendulum", {"titel", "title"}},
        Bad{"version", "recipe/1", "recipe/2", {"recipe/1"}},
        Bad{"method", "window_fit", "windows_fit", {"windows_fit", "did you mean window_fit"}},
        Bad{"parameter",
            "viscous@drive:damping",
            "viscous@drive:dampin",
            {"dampin", "did you mean viscous@drive:damping"}},
        Bad{"unknown_in_link",
            "damping: friction",
            "damping: frictoin",
            {"frictoin", "did you mean friction"}},
        Bad{"unknown_in_free", "free: [friction]", "free: [fricton]", {"fricton", "did you mean friction"}},
        Bad{"not_linked", "free: [friction]", "free: [lump]", {"lump", "links to a parameter"}},
        Bad{"twice", "free: [friction]", "free: [friction, friction]", {"a second time"}},
        Bad{"nothing_free", "free: [friction]", "free: []", {"an empty list"}},
        Bad{"free_and_known",
            "free: [friction]",
            "free: [friction]\n    known: [friction]",
            {"which is free too"}},
        Bad{"model", "model: bench", "model: bensch", {"bensch", "did you mean bench"}},
        Bad{"model_file", "model.yaml", "modell.yaml", {"modell.yaml", "not there"}},
        Bad{"experiment", "chirp.yaml", "chrip.yaml", {"chrip.yaml", "not there"}},
        Bad{"no_data",
            "    experiments:",
            "    window: {value: 1, unit: s}\n    #",
            {"a step without data", "experiments, trials"}},
        Bad{"no_window",
            "    experiments:",
            "    window: {value: 0, unit: s}\n    experiments:",
            {"window", "a time above zero"}},
        Bad{"two_data", "    free:", "    trials: [x]\n    free:", {"trials", "one source of data"}},
        Bad{"data_of", "    experiments:", "    data_of: chip\n    #", {"chip", "earlier step"}},
        Bad{"unit", "    unit: kg m^2", "    unit: furlongs!", {"furlongs!"}},
        Bad{"link_unit", "unit: N m s/rad, uncertainty", "unit: N m, uncertainty", {"N m s/rad"}},
        Bad{"power",
            "damping: friction",
            "damping: {unknown: friction, power: -1}",
            {"power -1", "a pure number"}},
        Bad{"other_power",
            "damping: friction",
            "damping: {unknown: friction, power: 1e300}",
            {"1e300", "1 or -1"}},
        Bad{"target", "target: 2 %", "target: soon", {"soon"}},
        Bad{"steps", "steps:\n  - step: chirp", "steps: []\nunused:\n  - step: chirp", {"unused"}}),
    [](const auto& bad) { return bad.param.name; });

TEST(Recipe, KnownBeforeItIsEstimatedIsRefused) {
  const test::TemporaryFolder folder;
  std::string text =
      test::with(test::pendulum_recipe(), "    links:\n", "    links:\n      load_friction@x:y: lump\n");
  text = test::pendulum_recipe();
  text = test::with(text, "    stated: {value: 1.0e-4, unit: N m s/rad, uncertainty: 30 %, source: a test}\n",
                    "");
  text = test::with(text, "free: [friction]",
                    "free: [friction]\n  - step: next\n    title: t\n    source: s\n"
                    "    method: window_fit\n    model: bench\n    data_of: chirp\n"
                    "    free: [friction]\n");
  EXPECT_NO_THROW(read_recipe(folder.write("fine.yaml", text), model::known_effects()));
  const std::string equation =
      test::with(test::pendulum_recipe(), "steps:\n",
                 "steps:\n  - step: factors\n    title: t\n    source: s\n    method: equation_14\n"
                 "    rotor_inertia: {value: 1e-4, unit: kg m^2, source: s}\n"
                 "    rows: [{lumped: lump, pulleys: {value: 0, unit: kg m^2, source: s}}]\n"
                 "    torque_factor: friction\n    rotor_factor: friction\n");
  const std::string message =
      test::refusal([&] { read_recipe(folder.write("bad.yaml", equation), model::known_effects()); });
  EXPECT_THAT(message, HasSubstr("an earlier step estimates"));
}

TEST(Recipe, TwinsNeedASeed) {
  const test::TemporaryFolder folder;
  const Recipe recipe =
      read_recipe(folder.write("recipe.yaml", test::pendulum_recipe()), model::known_effects());
  const std::string message =
      test::refusal([&] { run_recipe(recipe, {}, [](const std::string&, double) {}); });
  EXPECT_THAT(message, HasSubstr("chirp"));
  EXPECT_THAT(message, HasSubstr("--seed"));
}

}  // namespace
}  // namespace plumbline::validation
