// Derivatives of windows of a robot with a closed loop.
#include <gtest/gtest.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/windows.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

constexpr const char* kFolder = PLUMBLINE_ROOT "/tests/robots/four_bar/";

model::Model leg() {
  model::Model model = model::read_model(std::string(kFolder) + "model.yaml", model::known_effects());
  model.effects.push_back(parse_effect("viscous@knee:damping=0.05", model, model::known_effects()));
  return model;
}

/// The same leg with a rod in the coupler's place, which stretches.
model::Model leg_with_pushrod() {
  model::Model model =
      model::read_model(PLUMBLINE_ROOT "/tests/robots/pushrod/model.yaml", model::known_effects());
  model.effects.push_back(
      parse_effect("cable_stretch@pushrod:stiffness=5000,damping=5", model, model::known_effects()));
  return model;
}

// The oracle is differences of whole predictions, which close the loop where they begin and after every step.
void expect_derivatives(const model::Model& model) {
  constexpr double kStep = 1e-5;
  constexpr double kShare = 0.02;  // the rigid parts are those of each sample's beginning
  const Trial trial =
      twin(model, read_experiment(std::string(kFolder) + "experiments/steps.yaml", model), {});
  const std::vector<FreeParameter> parameters = free_parameters(model);
  PredictOptions options;
  options.relative_tolerance = 1e-10;
  Predictor predictor(model, trial, options);
  const Window window{0, 900, 400, {}};
  const Eigen::VectorXd x0 = predictor.initial_state(window);
  if (predictor.plant().has_loops()) {
    EXPECT_LT(predictor.plant().loop_errors(x0.data()).maxCoeff(), 1e-12);
  }
  const Linearisation found = predictor.linearise(window, x0, parameters);
  for (Eigen::Index i = 0; i < x0.size(); ++i) {
    const Eigen::VectorXd unit = kStep * Eigen::VectorXd::Unit(x0.size(), i);
    const Eigen::VectorXd below = predictor.residual(window, x0 - unit);
    const Eigen::VectorXd differences = (below - predictor.residual(window, x0 + unit)) / (2.0 * kStep);
    EXPECT_LT((found.Jx.col(i) - differences).norm(), kShare * differences.norm()) << "state " << i;
  }
  ASSERT_FALSE(parameters.empty());
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    model::Plant& plant = predictor.plant();
    const double value = plant.value(parameters[p].id);
    const double change = 1e-3 * value;
    parameters[p].set(plant, value - change);
    const Eigen::VectorXd below = predictor.residual(window, x0);
    parameters[p].set(plant, value + change);
    const Eigen::VectorXd differences = (below - predictor.residual(window, x0)) / (2.0 * change);
    parameters[p].set(plant, value);
    EXPECT_LT((found.Jp.col(static_cast<Eigen::Index>(p)) - differences).norm(), kShare * differences.norm())
        << parameters[p].label;
  }
}

TEST(Loops, DerivativesAgreeWithDifferences) { expect_derivatives(leg()); }

TEST(Loops, DerivativesOfAStretchedRodAgreeWithDifferences) { expect_derivatives(leg_with_pushrod()); }

// From the readings alone the state is the twin's own, to the encoders' counts.
TEST(Loops, StatesComeFromTheEncoders) {
  const model::Model model = leg();
  const Trial trial =
      twin(model, read_experiment(std::string(kFolder) + "experiments/swing.yaml", model), {});
  Predictor predictor(model, trial, {});
  const Eigen::MatrixXd z = predictor.measured_positions();
  double open = 0.0;
  for (Eigen::Index k = 0; k < z.cols(); k += 50) {
    open = std::max(open, predictor.plant().closure()->errors(z.col(k)).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(open, 1e-12);
  const Eigen::VectorXd r = predictor.residual({0, 0, 500, {}}, predictor.initial_state({0, 0, 500, {}}));
  // Floors are deviations of quantisation. The slope of a line through n = 25 readings a millisecond apart is
  // off by sqrt(12/n) / 0.025 s of them, that of a parabola at its end by four times as much; over half a
  // second the position's rms is 0.5 s / sqrt(3) of it.
  const double straight = std::sqrt(12.0 / 25.0) / 0.025 * 0.5 / std::sqrt(3.0);
  EXPECT_LT(std::sqrt(r.squaredNorm() / static_cast<double>(r.size())), 4.0 * straight);
}

}  // namespace
}  // namespace plumbline::validation
