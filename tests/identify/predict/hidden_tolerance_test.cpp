// Hidden states are integrated as finely as the channels can show, however fast they are against a sample.
#include <gtest/gtest.h>

#include "simulator/effects/catalogue.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/predict/windows.h"
#include "validation/identify/trial/trial.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

model::EffectUse current_loop(double time_constant) {
  model::EffectUse use;
  use.law = effects::Catalogue::all().find("current_loop");
  use.at = "drive";
  use.values.resize(2);
  use.values[0].value = time_constant;
  use.values[1].value = 0.5;
  return use;
}

/// By time constant, s; a sample takes 1 ms.
class FastHiddenState : public testing::TestWithParam<double> {
 protected:
  const std::string folder_ = PLUMBLINE_ROOT "/tests/robots/pendulum/";
  const model::Model given_ = model::read_model(folder_ + "model.yaml", effects::Catalogue::all());
  const Trial trial_ = twin(given_, read_experiment(folder_ + "experiments/chirp.yaml", given_), {});
  const Window window_{0, 100, 400};
};

TEST_P(FastHiddenState, IsFollowedWithFewStepsAndWithinTheFloors) {
  model::Model model = given_;
  model.effects.push_back(current_loop(GetParam()));
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

INSTANTIATE_TEST_SUITE_P(, FastHiddenState, testing::Values(2e-6, 2e-5, 1e-4, 5e-4, 5e-3));

}  // namespace
}  // namespace plumbline::validation
