// A window that cannot be integrated has an infinite error, and ends no other work.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/estimate.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

class NotIntegrated : public testing::Test {
 protected:
  /// Two windows; in the second no torque is known.
  Data broken(Role role) const {
    Experiment experiment = read_experiment(folder_ + "experiments/steps.yaml", model_);
    experiment.time.conservativeResize(1000);
    for (Command& command : experiment.commands) {
      command.values.conservativeResize(1000);
    }
    experiment.role = Role::train;
    const Trial right = twin(model_, experiment, {});
    Trial trial = right;
    trial.role = role;
    trial.commands[0].values.tail(200).setConstant(std::numeric_limits<double>::quiet_NaN());
    return role == Role::test ? Data({right, trial}, {}) : Data({trial}, {});
  }

  const std::string folder_ = PLUMBLINE_ROOT "/tests/robots/pendulum/";
  const model::Model model_ = model::read_model(folder_ + "model.yaml", model::known_effects());
};

TEST_F(NotIntegrated, AWindowHasAnInfiniteErrorAndTheOthersTheirs) {
  const Data data = broken(Role::train);
  ASSERT_EQ(data.windows.size(), 2U);
  PredictorPool pool(model_, data);
  const Estimate estimate = estimate_states(pool);
  EXPECT_FALSE(is_finite(estimate));
  EXPECT_EQ(estimate.scores.train, kInfinite);
  EXPECT_EQ(estimate.predicted.scores.train, kInfinite);
  EXPECT_EQ(estimate.cost, kInfinite);
  ASSERT_EQ(estimate.square.size(), 2U);
  EXPECT_TRUE(std::isfinite(estimate.square[0].sum()));
  EXPECT_EQ(estimate.square[1].sum(), kInfinite);
}

TEST_F(NotIntegrated, ASearchFromThereBeginsOnlyWhereItIsTried) {
  const Data data = broken(Role::train);
  const std::vector<FreeParameter> parameters = free_parameters(model_);
  PredictorPool pool(model_, data);
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(parameters.size()), 1e-4);
  EXPECT_THROW(gauss_newton(pool, parameters, start, {}, {}), std::runtime_error);
  const Estimate tried = try_gauss_newton(pool, parameters, start, {}, {});
  EXPECT_EQ(tried.theta, start);
  EXPECT_EQ(tried.cost, kInfinite);
  EXPECT_FALSE(tried.converged);
}

TEST_F(NotIntegrated, ATestTrialHasAnInfiniteError) {
  EXPECT_EQ(test_error(model_, broken(Role::test)), kInfinite);
}

}  // namespace
}  // namespace plumbline::validation
