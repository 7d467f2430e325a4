// Derivatives by differences, and parameters that move together.
#include <gtest/gtest.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/studies/recipes/pendulum_recipe.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/windows.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

class Pendulum : public testing::Test {
 protected:
  model::Model model_ = model::read_model(test::pendulum_robot("model.yaml"), model::known_effects());
  Trial trial_ = twin(model_, read_experiment(test::pendulum_robot("experiments/chirp.yaml"), model_), {});
  std::vector<FreeParameter> parameters_ = free_parameters(model_);
  Window window_{0, 1000, 300};
};

// Both are checked against each other here; the analytic one is checked by itself in tests/limits.
TEST_F(Pendulum, DifferencesAgreeWithTheSensitivities) {
  PredictOptions options;
  options.relative_tolerance = 1e-9;
  Predictor analytic(model_, trial_, options);
  options.differences = true;
  Predictor differences(model_, trial_, options);
  const Eigen::VectorXd x0 = analytic.initial_state(window_);
  const Linearisation one = analytic.linearise(window_, x0, parameters_);
  const Linearisation two = differences.linearise(window_, x0, parameters_);
  EXPECT_EQ(one.r, two.r);
  EXPECT_LT((one.Jx - two.Jx).norm(), 2e-3 * one.Jx.norm());
  EXPECT_LT((one.Jp - two.Jp).norm(), 2e-3 * one.Jp.norm());
}

// The friction stated twice, half at each use, moved together: the derivative is that of one friction,
// counted twice.
TEST_F(Pendulum, TiedParametersAddUp) {
  model::Model twice = model_;
  twice.effects.push_back(twice.effects.front());
  FreeParameter both = parameters_.front();
  both.also.push_back({static_cast<int>(twice.effects.size()) - 1, both.id.parameter});
  for (const bool differences : {false, true}) {
    PredictOptions options;
    options.differences = differences;
    Predictor predictor(twice, trial_, options);
    const Eigen::VectorXd x0 = predictor.initial_state(window_);
    const Linearisation tied = predictor.linearise(window_, x0, {both});
    const Linearisation alone = predictor.linearise(window_, x0, parameters_);
    EXPECT_LT((tied.Jp.col(0) - 2.0 * alone.Jp.col(0)).norm(), 2e-3 * tied.Jp.norm()) << differences;
  }
}

}  // namespace
}  // namespace plumbline::validation
