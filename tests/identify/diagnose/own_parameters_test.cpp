// Robots that differ from their model within what it states, and robots that do not.
#include "validation/identify/diagnose/own_parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/deviations.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

const std::vector<std::string> kScatter{"torque_constant_error@drive:scale=1.04",
                                        "rotor_inertia@drive:inertia=-2e-6", "added_mass@arm:mass=0.01",
                                        "viscous@drive:damping=2e-5"};

Diagnosis diagnosed(const std::vector<std::string>& hidden) {
  const model::Model bare = pendulum_drive();
  const Data data = pendulum_twins(hidden);
  return diagnose(bare, effects::Catalogue::all(), data, {}, silent);
}

TEST(OwnParameters, StatedErrorsAreThereAndChangeNothing) {
  const model::Model bare = pendulum_drive();
  const model::Model open = with_stated_errors(bare);
  std::vector<std::string> labels;
  for (const FreeParameter& parameter : stated_parameters(open, 3.0)) {
    labels.push_back(parameter.label);
  }
  EXPECT_THAT(labels,
              testing::UnorderedElementsAre("viscous@drive:damping", "torque_constant_error@drive:scale",
                                            "rotor_inertia@drive:inertia", "added_mass@arm:mass"));
  const Data data = pendulum_twins({});
  EXPECT_NEAR(as_given(open, data).estimate.scores.held_out, as_given(bare, data).estimate.scores.held_out,
              1e-6);
}

TEST(OwnParameters, DataSpeakForTheStatedNumbersOnlyWhereTheyAreTrue) {
  const model::Model bare = pendulum_drive();
  const Data exact = pendulum_twins({});
  const Data other = pendulum_twins(kScatter);
  EXPECT_GT(evidence_for_stated(as_given(bare, exact), exact, 3.0), std::log(100.0));
  EXPECT_LT(evidence_for_stated(as_given(bare, other), other, 3.0), 0.0);
}

/// The model's own numbers fitted, nothing added.
Stage with_own_fitted(const model::Model& bare, const Data& data) {
  Stage stage{with_stated_errors(bare), {}, {}};
  stage.parameters = stated_parameters(stage.model, 3.0);
  return fitted_anew(stage, data);
}

// The density ratio is one number, from wherever the log density is expanded.
TEST(OwnParameters, EvidenceIsTheSameWhereTheNumbersWereFitted) {
  const model::Model bare = pendulum_drive();
  const Data exact = pendulum_twins({});
  const Data other = pendulum_twins(kScatter);
  EXPECT_NEAR(evidence_for_stated(with_own_fitted(bare, exact), exact, 3.0),
              evidence_for_stated(as_given(bare, exact), exact, 3.0), 2.0);
  EXPECT_LT(evidence_for_stated(with_own_fitted(bare, other), other, 3.0), -std::log(100.0));
}

TEST(OwnParameters, AnHonestScatterIsNoMissingEffect) {
  const Diagnosis d = diagnosed(kScatter);
  EXPECT_EQ(d.verdict, Verdict::nothing_missing);
  EXPECT_TRUE(d.accepted.empty());
  EXPECT_GT(d.ladder.front().held_out(), 2.0);
  for (const OwnParameter& own : own_values(d.final_stage)) {
    EXPECT_LE(std::abs(own.shift()), 3.0) << own.label;
  }
}

TEST(OwnParameters, AnEffectIsFoundThroughTheScatter) {
  std::vector<std::string> hidden = kScatter;
  hidden.push_back("coulomb@drive:level=2e-4,smoothing_speed=0.1");
  const Diagnosis d = diagnosed(hidden);
  EXPECT_EQ(d.verdict, Verdict::missing);
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.accepted[0].effect, "coulomb");
  EXPECT_NEAR(d.accepted[0].parameters[0].value, 2e-4, 2e-5);
}

// Beside what was named: that stays last in the model, and every parameter stays with its law.
TEST(OwnParameters, AreOpenedBesideWhatWasNamed) {
  model::Model model = pendulum_drive();
  model.effects.push_back(
      parse_effect("coulomb@drive:level=1e-4,smoothing_speed=0.1", model, effects::Catalogue::all()));
  Stage named{model, matching(free_parameters(model), {"coulomb@drive:level"}), {}};
  const Data data({twin(model, read_experiment("tests/robots/pendulum/experiments/chirp.yaml", model), {})},
                  {});
  named = fitted_anew(named, data);
  const Stage open = with_open_numbers(named, 1, 3.0, data);
  EXPECT_EQ(open.model.effects.back().law->declaration().name, "coulomb");
  ASSERT_GT(open.parameters.size(), 2U);
  for (const FreeParameter& parameter : open.parameters) {
    const model::EffectUse& use = open.model.effects[static_cast<std::size_t>(parameter.id.effect)];
    EXPECT_EQ(parameter.label.rfind(use.law->declaration().name + "@" + use.at, 0), 0U) << parameter.label;
  }
  const auto own = std::count_if(open.parameters.begin(), open.parameters.end(),
                                 [](const FreeParameter& one) { return std::isfinite(one.deviation); });
  EXPECT_EQ(own + 1, static_cast<std::ptrdiff_t>(open.parameters.size()));
}

// Robots whose numbers scatter as their model states: the values at which data and statement together end
// must lie as far from the true ones as their deviations say. Of 120 intervals of 95 %, 114 +- 2.4.
TEST(OwnParameters, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const model::Model open = with_stated_errors(pendulum_drive());
  const std::vector<FreeParameter> parameters = stated_parameters(open, 3.0);
  const Experiment chirp = read_experiment("tests/robots/pendulum/experiments/chirp.yaml", open);
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  int inside = 0;
  for (int robot = 0; robot < 30; ++robot) {
    Eigen::VectorXd truth(static_cast<Eigen::Index>(parameters.size()));
    for (Eigen::Index p = 0; p < truth.size(); ++p) {
      const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
      truth[p] = parameter.mean + std::clamp(normal(random), -2.0, 2.0) * parameter.deviation;
    }
    const Data data({twin(with_values(open, parameters, truth), chirp, {})}, {});
    const Stage fitted = fitted_anew({open, parameters, {}}, data);
    PredictorPool pool(open, data);
    const Eigen::VectorXd deviations =
        precision_of(pool, data.all_windows(), parameters, fitted.estimate).deviations;
    for (Eigen::Index p = 0; p < truth.size(); ++p) {
      inside += std::abs(fitted.estimate.theta[p] - truth[p]) < 1.96 * deviations[p] ? 1 : 0;
    }
  }
  EXPECT_GE(inside, 108);
  EXPECT_LE(inside, 119);
}

// A locked motor's encoder shows one count throughout, off by up to half of it: no number of samples tells
// its offset better than that.
TEST(OwnParameters, ALockedEncoderIsReadOnce) {
  const Data data = bench_twins({"encoder_offset@mLA:offset=0.0142"});
  model::Model model = bench();
  model.effects.push_back(parse_effect("encoder_offset@mLA:offset=0.01", model, effects::Catalogue::all()));
  const std::vector<FreeParameter> offset = matching(free_parameters(model), {"encoder_offset@mLA:*"});
  PredictorPool pool(model, data);
  const Estimate found = gauss_newton(pool, offset, Eigen::VectorXd::Constant(1, 0.01), {}, {8, 1e-6});
  const Eigen::VectorXd deviations =
      precision_of(pool, data.windows_of(Role::train), offset, found).deviations;
  const double count = model.find_sensor("mLA")->resolution;
  EXPECT_LT(std::abs(found.theta[0] - 0.0142), 1.96 * deviations[0]);
  EXPECT_GT(std::abs(found.theta[0] - 0.0142), 0.05 * count);
  EXPECT_LT(deviations[0], count);
}

TEST(OwnParameters, OneNumberAloneIsNamedWhereAllOthersAreAsStated) {
  const Diagnosis d = diagnosed({"torque_constant_error@drive:scale=1.04"});
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.accepted[0].effect, "torque_constant_error");
  EXPECT_NEAR(d.accepted[0].parameters[0].value, 1.04, 1e-3);
}

}  // namespace
}  // namespace plumbline::validation
