// What is said where a diagnosis ends, and of how many effects.
#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/finish.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

// The first rung is of short segments of the windows on which nothing was missing, the last of all that could
// be followed.
TEST(Conclude, WhereNothingWasAddedTheLastErrorCounts) {
  const Data data = bench_twins({"coulomb@mLA:level=0.02"}).thinned(2);
  Diagnosis diagnosis;
  Rung rung{"as given", as_given(bench(), data), 0.2};
  rung.stage.estimate.predicted.scores.held_out = 0.95;
  diagnosis.ladder.push_back(rung);
  rung.length = 0.5;
  rung.stage.estimate.predicted.scores.held_out = 2.6;
  diagnosis.ladder.push_back(rung);
  diagnosis.final_stage = rung.stage;

  conclude(data, {}, diagnosis);
  EXPECT_EQ(diagnosis.verdict, Verdict::unexplained);
  EXPECT_EQ(diagnosis.unexplained_share, 1.0);

  diagnosis.final_stage.estimate.predicted.scores.held_out = 1.0;
  conclude(data, {}, diagnosis);
  EXPECT_EQ(diagnosis.verdict, Verdict::nothing_missing);
  EXPECT_EQ(diagnosis.unexplained_share, 0.0);
}

// What standard identification does without is no name any more, and the model is that without it.
TEST(Conclude, AWithdrawnNameIsToldAndLeavesTheModel) {
  const Data data = bench_twins({"coulomb@mLA:level=0.02"}).thinned(2);
  Diagnosis diagnosis;
  diagnosis.ladder.push_back({"as given", as_given(bench(), data)});
  diagnosis.accepted.emplace_back();
  diagnosis.accepted.back().effect = "load_friction";
  diagnosis.accepted.back().at = "mLA";
  Stage with = diagnosis.ladder.front().stage;
  with.model.effects.push_back(parse_effect("load_friction@mLA", bench(), effects::Catalogue::all()));
  diagnosis.ladder.push_back({"+ load_friction@mLA", with});
  diagnosis.final_stage = with;

  withdraw_names(data, {}, diagnosis);
  EXPECT_TRUE(diagnosis.accepted.empty());
  ASSERT_EQ(diagnosis.withdrawn.size(), 1U);
  EXPECT_EQ(diagnosis.withdrawn.front().label(), "load_friction@mLA");
  EXPECT_EQ(diagnosis.final_stage.model.effects.size(), bench().effects.size());
  EXPECT_EQ(diagnosis.ladder.size(), 1U);
  EXPECT_EQ(diagnosis.verdict, Verdict::unexplained);
}

// The errors that are reported decide, whatever was seen on the way.
TEST(Conclude, SaysWhetherANameHasRaisedTheHeldOutError) {
  const Data data = bench_twins({}).thinned(2);
  Diagnosis diagnosis;
  diagnosis.accepted.emplace_back();
  diagnosis.accepted.back().held_out_before = 14.8;
  diagnosis.accepted.back().held_out_after = 14.7;
  EXPECT_FALSE(has_risen(data, diagnosis));
  diagnosis.accepted.back().held_out_after = 19.1;
  EXPECT_TRUE(has_risen(data, diagnosis));
}

Finding finding_at(const std::string& effect, const std::string& at) {
  Finding finding;
  finding.effect = effect;
  finding.at = at;
  return finding;
}

/// The bench with these effects at mLA, named in this order, and their values fitted.
Diagnosis named(const std::vector<std::string>& effects, const Data& data) {
  const effects::Catalogue catalogue = effects::Catalogue::all();
  Diagnosis diagnosis;
  Stage& stage = diagnosis.final_stage;
  stage.model = bench();
  for (const std::string& effect : effects) {
    const Finding finding = finding_at(effect, "mLA");
    stage.model.effects.push_back(parse_effect(finding.label(), bench(), catalogue));
    diagnosis.accepted.push_back(finding);
  }
  const auto last = static_cast<int>(stage.model.effects.size());
  for (const FreeParameter& parameter : free_parameters(stage.model)) {
    if (parameter.id.effect >= last - static_cast<int>(effects.size())) {
      stage.parameters.push_back(parameter);
    }
  }
  stage = fitted_anew(stage, data);
  diagnosis.ladder.push_back({"everything", stage});
  return diagnosis;
}

// What was replaced by a rival stands last, and is no more certain to be needed than the others.
TEST(DropSuperfluous, DropsWhatIsNotNeededWhereverItStands) {
  const Data data = bench_twins({"coulomb@mLA:level=0.02"}).thinned(4);
  for (const std::vector<std::string>& order :
       {std::vector<std::string>{"coulomb", "viscous"}, std::vector<std::string>{"viscous", "coulomb"}}) {
    Diagnosis diagnosis = named(order, data);
    drop_superfluous(data, {}, silent, diagnosis);
    ASSERT_EQ(diagnosis.accepted.size(), 1U) << order.front() << " first";
    EXPECT_EQ(diagnosis.accepted.front().label(), "coulomb@mLA");
    EXPECT_EQ(diagnosis.ladder.back().name, "- viscous@mLA");
  }
}

}  // namespace
}  // namespace plumbline::validation
