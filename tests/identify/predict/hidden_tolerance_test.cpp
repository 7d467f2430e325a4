// Hidden states are integrated as finely as the channels can show, however fast they are against a sample.
#include <gtest/gtest.h>

#include "simulator/effects/catalogue.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/windows.h"
#include "validation/identify/trial/trial.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

/// At the drive, with its two values.
model::EffectUse drive_law(const std::string& name, double time_constant, double other) {
  model::EffectUse use;
  use.law = effects::Catalogue::all().find(name);
  use.at = "drive";
  use.values.resize(2);
  use.values[0].value = time_constant;
  use.values[1].value = other;
  return use;
}

/// By time constant, s; a sample takes 1 ms.
class FastHiddenState : public testing::TestWithParam<double> {
 protected:
  const std::string folder_ = PLUMBLINE_ROOT "/tests/robots/pendulum/";
  const model::Model given_ = model::read_model(folder_ + "model.yaml", effects::Catalogue::all());
  const Trial trial_ = twin(given_, read_experiment(folder_ + "experiments/chirp.yaml", given_), {});
  const Window window_{0, 600, 150};
};

TEST_P(FastHiddenState, IsFollowedWithFewStepsAndWithinTheFloors) {
  model::Model model = given_;
  model.effects.push_back(drive_law("current_loop", GetParam(), 0.5));
  PredictOptions fine;
  fine.relative_tolerance = 1e-9;
  Predictor coarse(model, trial_, {});
  Predictor exact(model, trial_, fine);
  const Eigen::VectorXd x0 = coarse.initial_state(window_);
  const long before = coarse.evaluations();
  const Eigen::MatrixXd y = coarse.predict(window_, x0);
  constexpr double kMost = 60.0;  // rates of a sample; the model without the loop takes four
  EXPECT_LT(static_cast<double>(coarse.evaluations() - before), kMost * static_cast<double>(window_.count));
  const Eigen::MatrixXd off = y - exact.predict(window_, x0);
  for (int c = 0; c < coarse.channels(); ++c) {
    EXPECT_LT(off.col(c).cwiseAbs().maxCoeff(), 0.1 * coarse.floors()[c])
        << trial_.measured[static_cast<std::size_t>(c)].sensor;
  }
}

TEST_P(FastHiddenState, HasTheDerivativesOfDifferences) {
  if (GetParam() < 5e-5) {
    GTEST_SKIP() << "all that so short a lag does is less than a tenth of a floor";
  }
  for (const model::EffectUse& law :
       {drive_law("current_loop", GetParam(), 0.5), drive_law("winding", GetParam(), 1e-5)}) {
    model::Model model = given_;
    model.effects.push_back(law);
    const std::vector<FreeParameter> free = matching(free_parameters(model), {"*@drive:time_constant"});
    ASSERT_EQ(free.size(), 1U);
    PredictOptions by_differences;
    by_differences.differences = true;
    Predictor one(model, trial_, {});
    Predictor other(model, trial_, by_differences);
    const Eigen::VectorXd x0 = one.initial_state(window_);
    const Linearisation a = one.linearise(window_, x0, free);
    const Linearisation b = other.linearise(window_, x0, free);
    EXPECT_LT((a.Jp - b.Jp).norm(), 0.1 * b.Jp.norm()) << free.front().label;
  }
}

INSTANTIATE_TEST_SUITE_P(, FastHiddenState, testing::Values(2e-6, 2e-5, 1e-4, 5e-4, 5e-3));

}  // namespace
}  // namespace plumbline::validation
