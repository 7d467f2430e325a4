// Where hundreds of floors remain whatever one does: several effects at once, laws that trade with a model
// parameter, records whose zeros are off.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "simulator/model/robot_file.h"
#include "tests/identify/diagnose/bench.h"
#include "tests/identify/predict/hopper.h"
#include "validation/identify/diagnose/family.h"
#include "validation/identify/diagnose/objection.h"
#include "validation/identify/diagnose/own_parameters.h"
#include "validation/identify/diagnose/standard_effects.h"
#include "validation/identify/predict/lost_windows.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

model::EffectUse use_of(const std::string& law, const std::string& at) {
  model::EffectUse use;
  use.law = effects::Catalogue::all().find(law);
  use.at = at;
  return use;
}

TEST(Family, IsOfOnePlace) {
  const TiedPlaces places(bench());
  const auto are_one = [&](const char* law, const char* at, const char* other, const char* there) {
    return are_of_one_family(use_of(law, at), use_of(other, there), places);
  };
  EXPECT_TRUE(are_one("coulomb", "mLA", "stribeck", "mLA"));
  EXPECT_TRUE(are_one("coulomb", "mLA", "hysteresis", "leg_angle"))
      << "the motor turns it through a rigid ratio";
  EXPECT_FALSE(are_one("coulomb", "mLA", "stribeck", "mLS"));
  EXPECT_FALSE(are_one("coulomb", "mLA", "preload", "mLA"));
  EXPECT_FALSE(are_one("boom", "base", "boom", "base")) << "a family needs two";
}

Data friction_at_both_motors() {
  return bench_twins({"coulomb@mLA:level=0.05", "viscous@mLA:damping=0.004", "coulomb@mLS:level=0.08",
                      "viscous@mLS:damping=0.006"})
      .thinned(8);
}

// Friction of both kinds at both motors: one after the other the search would name compromises.
TEST(FrictionEverywhere, IsFoundAtOnce) {
  const Data data = friction_at_both_motors();
  const Policy policy;
  const Tried tried =
      try_candidates(as_given(bench(), data), some_laws({"coulomb", "viscous"}), {}, data, policy, silent);
  const std::optional<Group> group = standard_effects(tried, data, policy, silent);
  ASSERT_TRUE(group);
  std::vector<std::string> labels;
  for (const Candidate& candidate : group->candidates) {
    labels.push_back(candidate.label());
  }
  EXPECT_THAT(labels, testing::IsSupersetOf({"coulomb@mLA", "viscous@mLA", "coulomb@mLS", "viscous@mLS"}));
  EXPECT_LT(group->stage.estimate.scores.train, 1.1);
}

// A motor that gives a fiftieth of what is stated is no motor of this robot: such a gain is no member.
TEST(FrictionEverywhere, HasNoGainAtItsLimit) {
  const Data data = bench_twins({"coulomb@mLA:level=0.05", "viscous@mLA:damping=0.004",
                                 "torque_constant_error@mLS:scale=0.02"})
                        .thinned(8);
  const Policy policy;
  const Tried tried = screen_candidates(
      as_given(bench(), data), some_laws({"coulomb", "viscous", "torque_constant_error"}), {}, data, silent);
  const std::optional<Group> group = standard_effects(tried, data, policy, silent);
  if (group) {
    for (const Candidate& candidate : group->candidates) {
      EXPECT_NE(candidate.label(), "torque_constant_error@mLS");
    }
  }
}

// Hundreds of floors away it is asked before any single effect is refitted: by what these promise.
TEST(FrictionEverywhere, ComesFirstWhereNoSingleEffectPromisesAsMuch) {
  const Data data = friction_at_both_motors();
  const Policy policy;
  const Tried both =
      screen_candidates(as_given(bench(), data), some_laws({"coulomb", "viscous"}), {}, data, silent);
  ASSERT_TRUE(both.refits.empty());
  const std::optional<Group> group = standard_effects(both, data, policy, silent);
  ASSERT_TRUE(group);
  EXPECT_LT(group->stage.estimate.scores.train, 1.1);
  const Data one = bench_twins({"coulomb@mLA:level=0.05"}).thinned(8);
  EXPECT_FALSE(standard_effects(
      screen_candidates(as_given(bench(), one), some_laws({"coulomb", "viscous"}), {}, one, silent), one,
      policy, silent));
}

/// Windows of a double pendulum that swings over, half a second and more of it far from linear in where they
/// begin, and a share of the friction that is in its motors.
struct SwingingOver {
  static constexpr double kShoulder = 0.24;  // N m
  static constexpr double kElbow = 0.17;
  model::Model bare = model::read_model("tests/robots/double_pendulum/model.yaml", effects::Catalogue::all());
  model::Model start = with_friction(0.02);
  Data data = recorded();
  std::vector<FreeParameter> parameters = levels();

  model::Model with_friction(double share) const {
    model::Model model = bare;
    for (const auto& [motor, level] :
         {std::pair("shoulder_motor", kShoulder), std::pair("elbow_motor", kElbow)}) {
      model.effects.push_back(
          parse_effect(fmt::format("coulomb@{}:level={}", motor, level), bare, effects::Catalogue::all()));
      model.effects.back().values.front().value *= share;
    }
    return model;
  }
  Data recorded() const {
    PredictOptions options;
    options.window = 1.0;
    return {{twin(with_friction(1.0), read_experiment("tests/robots/double_pendulum/swing.yaml", bare), {})},
            options};
  }
  std::vector<FreeParameter> levels() const {
    std::vector<FreeParameter> all;
    for (int effect = 0; effect < 2; ++effect) {
      for (const FreeParameter& one :
           free_parameters_of(start.effects[static_cast<std::size_t>(effect)], effect, {}, true)) {
        all.push_back(one);
      }
    }
    return all;
  }
};

// The step of a window's initial state that a straight line leads astray is damped; else such windows would
// refuse every step of the parameters, however short.
TEST(Search, WindowsThatAStraightLineLeadsAstrayHoldNothingBack) {
  const SwingingOver pendulum;
  ASSERT_EQ(pendulum.parameters.size(), 2U);
  PredictorPool pool(pendulum.start, pendulum.data);
  ASSERT_GT(estimate_states(pool).scores.train, 30.0);
  const Estimate found = gauss_newton(pool, pendulum.parameters,
                                      values_of(pendulum.start, pendulum.parameters), {}, {12, 1e-3, false});
  EXPECT_LT(found.scores.train, 1.1);
  EXPECT_NEAR(found.theta[0], SwingingOver::kShoulder, 0.002);
  EXPECT_NEAR(found.theta[1], SwingingOver::kElbow, 0.002);
}

// An error that is reported is what is left from the states that stand beside it, not what a straight line
// promises of the next step.
TEST(Search, ReportsTheErrorOfItsStates) {
  const SwingingOver pendulum;
  PredictorPool pool(pendulum.start, pendulum.data);
  // Cut short far from where it leads.
  const Estimate found = gauss_newton(pool, pendulum.parameters,
                                      values_of(pendulum.start, pendulum.parameters), {}, {2, 1e-3, false});
  for (const int w : pendulum.data.all_windows()) {
    const auto i = static_cast<std::size_t>(w);
    pool.with(w, pendulum.parameters, found.theta, [&](Predictor& predictor) {
      const double left = predictor.residual(pendulum.data.windows[i], found.x0[i]).squaredNorm();
      EXPECT_NEAR(found.square[i].sum(), left, 0.01 * left) << "window " << w;
    });
  }
}

// One friction alone is named by itself: a group of several that does no better is none.
TEST(FrictionEverywhere, IsNothingWhereOneIsEnough) {
  const Data data = bench_twins({"coulomb@mLA:level=0.05"}).thinned(8);
  const Policy policy;
  const Tried tried =
      try_candidates(as_given(bench(), data), some_laws({"coulomb", "viscous"}), {}, data, policy, silent);
  EXPECT_FALSE(standard_effects(tried, data, policy, silent));
}

// Stated within 50 %, a rotor's inertia might be searched down to -50 %: a tenth of it is always there.
TEST(StatedParameters, StayThoseOfAPhysicalRobot) {
  model::Model model = model::read_model("tests/robots/pendulum/model.yaml", effects::Catalogue::all());
  const double inertia = model.motors.front().rotor_inertia.value;
  model.motors.front().rotor_inertia.uncertainty = 0.5 * inertia;
  for (const FreeParameter& parameter : stated_parameters(with_stated_errors(model), 3.0)) {
    if (parameter.label == "rotor_inertia@drive:inertia") {
      EXPECT_DOUBLE_EQ(parameter.lower, -0.9 * inertia);
      EXPECT_DOUBLE_EQ(parameter.upper, 1.5 * inertia);
      return;
    }
  }
  FAIL() << "no rotor inertia among the stated parameters";
}

// What cannot be integrated costs its window, not the command.
TEST(LostWindows, AreNamedAndTheOthersStay) {
  const Data data = bench_twins({});
  std::vector<LostWindow> lost;
  EXPECT_EQ(without_lost(bench(), data, lost).windows.size(), data.windows.size());
  EXPECT_TRUE(lost.empty());
  Data broken = data;
  broken.trials.front()
      .commands.front()
      .values.segment(broken.windows[1].first, 5)
      .setConstant(std::numeric_limits<double>::quiet_NaN());
  const Data kept = without_lost(bench(), broken, lost);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost.front().trial, "siso_mLA");
  EXPECT_DOUBLE_EQ(lost.front().from, data.trials.front().time[data.windows[1].first]);
  EXPECT_FALSE(lost.front().reason.empty());
  EXPECT_EQ(kept.windows.size() + 1, data.windows.size());
}

}  // namespace
}  // namespace plumbline::validation
