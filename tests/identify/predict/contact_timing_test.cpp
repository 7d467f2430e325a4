// Predicted instants of touchdown and lift-off, and derivatives through stance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/identify/predict/hopper.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {
namespace {

class HopperStance : public testing::Test {
 protected:
  /// A stance with a touchdown and a lift-off.
  Window stance(const Trial& trial) const {
    for (const Window& window : cut_windows({trial}, {})) {
      if (window.events.size() == 2) {
        return window;
      }
    }
    throw std::runtime_error("no whole stance");
  }
  /// The model with every error of the ground in it, at its null values.
  static model::Model with_ground_errors(model::Model model) {
    for (const char* name : {"ground_stiffness_error", "ground_damping_error", "ground_height_error"}) {
      model.effects.push_back(parse_effect(std::string(name) + "@toe", model, model::known_effects()));
    }
    return model;
  }

  const model::Model model_ = test::hopper();
  const Trial trial_ = test::hopper_trial(model_, "bounce");
};

// Without springs and torque everything falls together: the toe is at the ground after t = sqrt(2 h / g), and
// dt/dh = 1/(g t).
TEST_F(HopperStance, ATouchdownAfterAFreeFallComesWhenItMust) {
  model::Model loose = model_;
  loose.effects.erase(loose.effects.begin() + 1, loose.effects.begin() + 3);
  Trial fall = trial_;
  fall.contact_events = {{0.09, 90, 0, true}};
  fall.commands[0].values.setZero();
  const Window window{0, 0, 120, {0}};
  Predictor predictor(loose, fall, {});
  Eigen::VectorXd x0 = Eigen::VectorXd::Zero(predictor.plant().states());
  x0[0] = 0.44;
  const double g = loose.skeleton.gravity.norm();
  const double t = std::sqrt(2.0 * 0.04 / g);
  const Linearisation found = predictor.linearise(window, x0, {});
  const Eigen::Index last = found.r.size() - 1;
  EXPECT_NEAR(0.09 - found.r[last] * timing_floor(fall), t, 1e-6);
  EXPECT_NEAR(found.Jx(last, 0) * timing_floor(fall), 1.0 / (g * t), 1e-3 / (g * t));
}

// Predicted a millisecond behind the window's end, an instant is at least as far off as the end is: it is not
// one that does not come at all, which costs 10 ms. The same before its beginning.
TEST_F(HopperStance, AnInstantJustOutsideOfTheWindowCountsAsFarOffAsItsEnd) {
  model::Model loose = model_;
  loose.effects.erase(loose.effects.begin() + 1, loose.effects.begin() + 3);
  Trial fall = trial_;
  fall.contact_events = {{0.085, 85, 0, true}, {0.001, 1, 0, true}};
  fall.commands[0].values.setZero();
  Predictor predictor(loose, fall, {});
  Eigen::VectorXd x0 = Eigen::VectorXd::Zero(predictor.plant().states());
  const auto early = [&](const Window& window) {
    return predictor.residual(window, x0)[predictor.rows(window) - 1] * timing_floor(fall);
  };
  x0[0] = 0.44;  // lands after sqrt(2 * 0.04 / g) = 0.0903 s
  EXPECT_NEAR(early({0, 0, 88, {0}}), 0.085 - 0.087, 1e-9);
  EXPECT_NEAR(early({0, 0, 70, {0}}), 0.0, 1e-9);  // the window ends before it
  x0[0] = 0.399;                                   // in the ground from the beginning
  EXPECT_NEAR(early({0, 0, 20, {1}}), 0.001, 1e-9);
}

// The oracle is differences of whole predictions: the variational equations know nothing of them.
TEST_F(HopperStance, SensitivitiesThroughStanceAgreeWithDifferences) {
  const model::Model model = with_ground_errors(model_);
  std::vector<FreeParameter> parameters = free_parameters(model);
  for (FreeParameter& parameter : parameters) {
    parameter.typical = parameter.unit == "m" ? 2e-4 : parameter.typical;  // lengths that are zero here
  }
  PredictOptions options;
  options.relative_tolerance = 1e-9;
  Predictor analytic(model, trial_, options);
  options.differences = true;
  Predictor differences(model, trial_, options);
  const Window window = stance(trial_);
  const Eigen::VectorXd x0 = analytic.initial_state(window);
  const Linearisation one = analytic.linearise(window, x0, parameters);
  const Linearisation two = differences.linearise(window, x0, parameters);
  ASSERT_EQ(one.r, two.r);
  for (Eigen::Index i = 0; i < one.Jx.cols(); ++i) {
    EXPECT_LT((one.Jx.col(i) - two.Jx.col(i)).norm(), 0.02 * two.Jx.col(i).norm()) << "state " << i;
  }
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    EXPECT_LT((one.Jp.col(i) - two.Jp.col(i)).norm(), 0.02 * two.Jp.col(i).norm() + 1e-9)
        << parameters[p].label;
  }
}

// The predictor needs no option to see that a ground is stiff.
TEST_F(HopperStance, TheModelItselfStaysAtTheFloor) {
  Data data({trial_}, {});
  const Comparison comparison = compare(model_, data);
  EXPECT_LT(comparison.scores.train, 1.15);
  ASSERT_EQ(comparison.channels.back().name, "toe_switch");
  EXPECT_EQ(comparison.channels.back().unit, "s");
  EXPECT_LT(comparison.channels.back().ratio, 1.4);
  EXPECT_GT(comparison.channels.back().ratio, 0.6);
}

// The readings are 4 ms late at touchdown and 2 ms early at lift-off: whole samples, so that nothing is lost
// in their rounding.
TEST_F(HopperStance, ALateSwitchIsSeenAndFoundAgain) {
  model::Model truth = model_;
  truth.effects.push_back(parse_effect("switch_lateness@toe_switch:closes_late=0.004,opens_late=-0.002",
                                       model_, model::known_effects()));
  const Data data({test::hopper_trial(truth, "bounce")}, {});
  const Comparison as_given = compare(model_, data);
  EXPECT_GT(as_given.channels.back().ratio, 5.0);
  ASSERT_EQ(as_given.switches.size(), 2U);  // touchdowns and lift-offs
  EXPECT_TRUE(as_given.switches[0].closes && as_given.switches[0].is_steady());
  EXPECT_NEAR(as_given.switches[0].mean, 0.004, 2e-4);
  EXPECT_NEAR(as_given.switches[1].mean, -0.002, 2e-4);
  const Comparison known = compare(truth, data);
  EXPECT_FALSE(known.switches[0].is_steady() || known.switches[1].is_steady());
  EXPECT_LT(known.channels.back().ratio, 1.4);

  model::Model open = model_;
  open.effects.push_back(parse_effect("switch_lateness@toe_switch", model_, model::known_effects()));
  PredictorPool pool(open, data);
  std::vector<FreeParameter> parameters;
  for (const FreeParameter& one : free_parameters(open)) {
    if (one.id.effect == static_cast<int>(open.effects.size()) - 1) {
      parameters.push_back(one);
    }
  }
  ASSERT_EQ(parameters.size(), 2U);
  const Estimate found = gauss_newton(pool, parameters, Eigen::Vector2d::Zero(), {}, {10, 1e-4});
  EXPECT_NEAR(found.theta[0], 0.004, 3e-4);
  EXPECT_NEAR(found.theta[1], -0.002, 3e-4);
}

TEST_F(HopperStance, AWrongGroundIsSeenAndFoundAgain) {
  model::Model truth = model_;
  truth.effects.push_back(
      parse_effect("ground_height_error@toe:height=0.0004", model_, model::known_effects()));
  const Data data({test::hopper_trial(truth, "bounce")}, {});
  EXPECT_GT(compare(model_, data).scores.train, 3.0);
  const model::Model with = with_ground_errors(model_);
  const std::vector<FreeParameter> free = matching(free_parameters(with), {"ground_height_error@toe:height"});
  PredictorPool pool(with, data);
  const Estimate found = gauss_newton(pool, free, Eigen::VectorXd::Zero(1), {}, {12, 1e-4});
  EXPECT_NEAR(found.theta[0], 4e-4, 4e-6);
  EXPECT_LT(found.scores.train, 1.15);
}

}  // namespace
}  // namespace plumbline::validation
