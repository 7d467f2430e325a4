// The paper's whole sequence on one robot that does not exist.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/model/known_effects.h"
#include "validation/studies/recipes/run_recipe.h"
#include "validation/studies/recipes/twins.h"

namespace plumbline::validation {
namespace {

constexpr std::uint64_t kSeed = 11;

class MabelRecipe : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    recipe_ = read_recipe(std::string(PLUMBLINE_ROOT) + "/validation/studies/recipes/mabel",
                          model::known_effects());
    RecipeOptions options;
    options.seed = kSeed;
    result_ = run_recipe(recipe_, options, [](const std::string&, double) {});
  }

  static const IdentifiedValue& finding(const std::string& step, const std::string& unknown) {
    for (const StepResult& result : result_.steps) {
      for (const IdentifiedValue& found : result.findings) {
        if (result.step == step && found.unknown == unknown) {
          return found;
        }
      }
    }
    throw std::logic_error("no finding of " + unknown + " in " + step);
  }

  static Recipe recipe_;
  static RecipeResult result_;
};

Recipe MabelRecipe::recipe_;
RecipeResult MabelRecipe::result_;

TEST_F(MabelRecipe, MeetsItsTargetsAndNeverSawTheStatedValues) {
  int targets = 0;
  for (std::size_t s = 0; s < recipe_.steps.size(); ++s) {
    for (const IdentifiedValue& found : result_.steps[s].findings) {
      const Unknown& unknown = recipe_.unknown(found.unknown);
      if (!recipe_.steps[s].carried || !unknown.target) {
        continue;
      }
      const double truth = result_.truth.at(found.unknown);
      const double allowed = unknown.target->size * (unknown.target->relative ? std::abs(truth) : 1.0);
      EXPECT_NEAR(found.value, truth, allowed) << recipe_.steps[s].name << " " << found.unknown;
      EXPECT_NE(truth, unknown.value) << found.unknown;
      ++targets;
    }
  }
  EXPECT_GE(targets, 16);
}

TEST_F(MabelRecipe, SaysHowSureItIs) {
  int known = 0;
  int far = 0;
  for (std::size_t s = 0; s < recipe_.steps.size(); ++s) {
    for (const IdentifiedValue& found : result_.steps[s].findings) {
      const auto truth = result_.truth.find(found.unknown);
      if (recipe_.steps[s].carried && found.seen && truth != result_.truth.end()) {
        ++known;
        far += std::abs(found.value - truth->second) > 4.0 * found.deviation ? 1 : 0;
      }
    }
  }
  EXPECT_GE(known, 25);
  EXPECT_EQ(far, 0);
}

// The landings are predicted to the floor with what was found, and better than with what the model states.
TEST_F(MabelRecipe, RecoversTheGroundFromLandings) {
  const auto ground = std::find_if(result_.steps.begin(), result_.steps.end(),
                                   [](const StepResult& step) { return step.step == "ground"; });
  ASSERT_NE(ground, result_.steps.end());
  EXPECT_LT(ground->after, ground->before);
  EXPECT_LT(ground->after, 1.1);
  EXPECT_TRUE(ground->converged);
  for (const IdentifiedValue& found : ground->findings) {
    const double truth = result_.truth.at(found.unknown);
    EXPECT_LT(std::abs(found.value - truth), 4.0 * found.deviation) << found.unknown;
    EXPECT_TRUE(std::isfinite(found.upper - found.lower)) << found.unknown;
  }
}

// Where a switch shows a landing its instant is known, and no window begins in it.
TEST_F(MabelRecipe, HopsHaveTheirContactSwitches) {
  const Step& step = recipe_.steps.back();
  ASSERT_TRUE(step.runs);
  const std::vector<Trial> trials = twin_trials(recipe_, step, result_.truth, 1, nullptr);
  ASSERT_EQ(trials.size(), static_cast<std::size_t>(step.runs->starts));
  for (const Trial& trial : trials) {
    EXPECT_EQ(trial.switches.size(), 2u);
    EXPECT_GE(trial.contact_events.size(), 1u) << "a foot lands; the other one may be later";
  }
}

// Equation 22 takes the whole weight at the hip. By the links of Table VI (leg straight under the hip, W =
// 636.6 N), all times sin(q_LS): thigh and shin miss (3.2818 * 0.1978 + 1.5007 * 0.657) kg m g = 16.0 N m;
// C_Spring, which hangs and turns by 2 q_LS, takes 4 * 2.199 N m cos(q_LS), and C_Shin 1.447 N m. At 20 deg
// that is 25.7 of 636.6 N m: K_B comes out 636.6/610.9 - 1 = 4.2 % too large. Between the poses' 8 and 30 deg
// it changes little; the rest is resolution.
TEST_F(MabelRecipe, Equation22LeavesOutTheLegsOwnWeight) {
  const double truth = result_.truth.at("spring_stiffness");
  const double printed = finding("spring_equation_22", "spring_stiffness").value / truth - 1.0;
  EXPECT_GT(printed, 0.025);
  EXPECT_LT(printed, 0.06);
}

}  // namespace
}  // namespace plumbline::validation
