// What a diagnosis says of itself in a few sentences.
#include "validation/report/sentences.h"

#include <gmock/gmock.h>

namespace plumbline::validation {
namespace {

using testing::HasSubstr;
using testing::Not;

Diagnosis found(const std::vector<std::string>& effects, Verdict verdict, double before, double after) {
  Diagnosis diagnosis;
  diagnosis.verdict = verdict;
  diagnosis.ladder.resize(2);  // train errors stay 0
  diagnosis.ladder[0].stage.estimate.predicted.scores.held_out = before;
  diagnosis.ladder[1].stage.estimate.predicted.scores.held_out = after;
  diagnosis.ladder[0].stage.estimate.scores.held_out = before;
  diagnosis.ladder[1].stage.estimate.scores.held_out = after;
  for (const std::string& effect : effects) {
    Finding finding;
    finding.effect = effect;
    finding.at = "drive";
    finding.held_out_before = before;
    finding.held_out_after = after;
    diagnosis.accepted.push_back(finding);
  }
  return diagnosis;
}

TEST(Summary, NamesOneEffectWithItsNumbers) {
  const std::string text = summary(found({"coulomb"}, Verdict::missing, 12.5, 1.01));
  EXPECT_THAT(text, HasSubstr("Missing: coulomb at drive."));
  EXPECT_THAT(text, HasSubstr("falls from 12.50 to 1.01 times the floor"));
}

TEST(Summary, NamesSeveralEffects) {
  const std::string text = summary(found({"coulomb", "viscous", "lugre"}, Verdict::missing, 12.5, 1.01));
  EXPECT_THAT(text, HasSubstr("Missing: coulomb at drive, viscous at drive and lugre at drive."));
}

TEST(Remarks, SayThePlaceWhereTheLawIsOpen) {
  Diagnosis diagnosis = found({}, Verdict::unexplained, 12.5, 9.0);
  diagnosis.at_one_place =
      OnePlace{"m_tail", 0.93, {{{"actuator_lag", "m_tail"}, 0.61}, {{"rotor_inertia", "tail"}, 0.32}}};
  const std::string said = testing::PrintToString(remarks(diagnosis));
  EXPECT_THAT(said, HasSubstr("Something is missing at m_tail: a law there is the best in 93 %"));
  EXPECT_THAT(said, HasSubstr("actuator_lag 61 %, rotor_inertia at tail 32 %."));
  diagnosis.verdict = Verdict::nothing_missing;
  EXPECT_THAT(testing::PrintToString(remarks(diagnosis)), Not(HasSubstr("m_tail")));
}

TEST(Summary, NothingIsMissingSaysWhichNumbersMoved) {
  Diagnosis diagnosis = found({}, Verdict::nothing_missing, 78.0, 1.02);
  EXPECT_THAT(summary(diagnosis), HasSubstr("Nothing is missing: the model predicts"));
  Stage& stage = diagnosis.final_stage;
  for (const char* label :
       {"added_mass@arm:mass", "torque_constant_error@drive:scale", "viscous@drive:damping"}) {
    FreeParameter parameter;
    parameter.label = label;
    parameter.deviation = 0.1;
    stage.parameters.push_back(parameter);
  }
  stage.estimate.theta = Eigen::Vector3d(0.2, -0.22, 0.01);
  const std::string text = summary(diagnosis);
  EXPECT_THAT(text,
              HasSubstr("torque_constant_error@drive:scale by -2.2, added_mass@arm:mass by +2.0 deviations"));
  EXPECT_THAT(text, Not(HasSubstr("viscous")));  // a tenth of a deviation is what any fit does
  EXPECT_THAT(text, HasSubstr("to 1.02 times what the sensors alone would leave; as given, to 78.00"));
}

TEST(Summary, SaysTheErrorOnTrialsThatNeitherFitNorChoose) {
  Diagnosis diagnosis = found({"coulomb"}, Verdict::missing, 12.5, 1.01);
  EXPECT_THAT(summary(diagnosis), Not(HasSubstr("role test")));
  diagnosis.test_before = 11.0;
  diagnosis.test_after = 1.03;
  EXPECT_THAT(summary(diagnosis), HasSubstr("goes from 11.00 to 1.03 times the floor"));
}

TEST(Summary, APartAndTheWholeSayOneNumber) {
  Diagnosis diagnosis = found({"coulomb"}, Verdict::unexplained, 12.5, 1.90);
  diagnosis.accepted.front().held_out_after = 1.03;  // on the windows on which it was tried
  EXPECT_THAT(
      finding_sentences(diagnosis.accepted.front(), diagnosis),
      HasSubstr("falls from 12.50 to 1.90 times the floor (1.03 on the windows on which it was tried)"));
}

TEST(Summary, SaysWhichWindowsEndEarly) {
  Diagnosis diagnosis = found({"coulomb"}, Verdict::missing, 12.5, 1.01);
  diagnosis.windows = 14;
  EXPECT_THAT(summary(diagnosis), Not(HasSubstr("windows")));
  diagnosis.cut_windows = 1;
  EXPECT_THAT(summary(diagnosis), HasSubstr("1 of 14 windows is not followed to its end"));
  diagnosis.cut_windows = 2;
  EXPECT_THAT(summary(diagnosis), HasSubstr("2 of 14 windows are not followed to their end"));
}

TEST(Summary, SaysHowManyWindowsALimitLeft) {
  Diagnosis diagnosis = found({"coulomb"}, Verdict::missing, 12.5, 1.01);
  diagnosis.all_windows = 60;
  EXPECT_THAT(summary(diagnosis), Not(HasSubstr("were used")));
  diagnosis.unused_windows = 36;
  EXPECT_THAT(summary(diagnosis), HasSubstr("Of 60 windows 24 were used, spread evenly over the trials"));
}

TEST(Summary, SaysWhatTheTrainTrialsLeaveOpen) {
  Diagnosis diagnosis = found({"com_shift"}, Verdict::missing, 12.5, 1.02);
  Scores& at_best_values = diagnosis.ladder[1].stage.estimate.scores;
  at_best_values.held_out = 1.05;
  EXPECT_THAT(summary(diagnosis), Not(HasSubstr("With caution")));
  at_best_values.held_out = 2.49;
  EXPECT_THAT(summary(diagnosis),
              HasSubstr("With caution: at the values that serve the train trials best the "
                        "held-out error is 2.49 times the floor. 1.02 grants"));
  diagnosis.verdict = Verdict::nothing_missing;
  diagnosis.accepted.clear();
  EXPECT_THAT(summary(diagnosis), HasSubstr("With caution"));
}

TEST(Summary, APartIsNotTheAnswer) {
  const std::string text = summary(found({"coulomb"}, Verdict::unexplained, 12.5, 5.0));
  EXPECT_THAT(text, HasSubstr("Found: coulomb at drive, a part of what is missing."));
  EXPECT_THAT(text, HasSubstr("to 5.00 times the floor"));
  EXPECT_THAT(text, Not(HasSubstr("Missing")));
}

TEST(Summary, SaysWhatWasTakenAsExactWhereSomethingIsLeft) {
  Diagnosis diagnosis = found({"coulomb"}, Verdict::unexplained, 12.5, 5.0);
  EXPECT_THAT(summary(diagnosis),
              HasSubstr("no uncertainty of its ratios, centres of mass, the commands' delays"));
  model::EffectUse shift;
  shift.law = effects::Catalogue::all().find("com_shift");
  shift.at = "arm";
  shift.values.resize(3);
  diagnosis.final_stage.model.effects.push_back(shift);
  EXPECT_THAT(summary(diagnosis), HasSubstr("centres of mass"));  // none is stated of it
  diagnosis.final_stage.model.effects.back().values[0].uncertainty = 3e-4;
  EXPECT_THAT(summary(diagnosis), HasSubstr("no uncertainty of its ratios, the commands' delays"));
  EXPECT_THAT(summary(found({"coulomb"}, Verdict::missing, 12.5, 1.0)), Not(HasSubstr("exact")));
}

TEST(Summary, WithoutHeldOutTrialsSpeaksOfTheTrainError) {
  Diagnosis diagnosis = found({"coulomb"}, Verdict::missing, 0.0, 0.0);
  diagnosis.accepted[0].train_before = 8.0;
  diagnosis.accepted[0].train_after = 1.0;
  EXPECT_THAT(summary(diagnosis),
              HasSubstr("With it the train error falls from 8.00 to 1.00 times the floor;"));
  diagnosis = found({}, Verdict::nothing_missing, 0.0, 0.0);
  diagnosis.ladder[1].stage.estimate.scores.train = 0.9;
  EXPECT_THAT(summary(diagnosis), HasSubstr("predicts the train motion to 0.90 times"));
}

TEST(Summary, NothingMissingAndNothingFinished) {
  EXPECT_THAT(summary(found({}, Verdict::nothing_missing, 1.0, 0.99)), HasSubstr("Nothing is missing"));
  EXPECT_EQ(summary(Diagnosis()), "Nothing was finished.");
}

}  // namespace
}  // namespace plumbline::validation
