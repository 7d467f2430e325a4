// Windows in which two links strike each other: derivatives, and a fit.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/fit/fit.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/windows.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

constexpr const char* kFolder = PLUMBLINE_ROOT "/tests/robots/bumpers/";

class Bumpers : public testing::Test {
 protected:
  Bumpers()
      : model_(model::read_model(std::string(kFolder) + "model.yaml", model::known_effects())),
        trial_(twin(model_, read_experiment(std::string(kFolder) + "experiments/push.yaml", model_), {})) {}

  /// The first sample at which the two are in contact.
  Eigen::Index first_contact(Predictor& predictor) const {
    const Eigen::MatrixXd z = predictor.measured_positions();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(predictor.plant().states());
    for (Eigen::Index k = 0; k < z.cols(); ++k) {
      x.head(z.rows()) = z.col(k);
      if (predictor.plant().link_touches(x.data()).front().depth > 0.0) {
        return k;
      }
    }
    return -1;
  }

  model::Model with_stiffness(double stiffness) const {
    model::Model model = model_;
    for (model::EffectUse& use : model.effects) {
      if (use.law->declaration().name == "ground_normal") {
        use.values[0].value = stiffness;
      }
    }
    return model;
  }

  model::Model model_;
  Trial trial_;
};

// The oracle is differences of whole predictions: the variational equations know nothing of them.
TEST_F(Bumpers, DerivativesAgreeWithDifferences) {
  constexpr double kStep = 1e-5;
  constexpr double kShare = 0.03;  // slopes of the laws are means over a sample
  const std::vector<FreeParameter> parameters = free_parameters(model_);
  PredictOptions options;
  options.relative_tolerance = 1e-10;
  options.method = integrate::Method::rosenbrock;
  Predictor predictor(model_, trial_, options);
  const Eigen::Index strikes = first_contact(predictor);
  ASSERT_GT(strikes, 60);
  const Window window{0, strikes - 50, 150, {}};
  const Eigen::VectorXd x0 = predictor.initial_state(window);
  const Linearisation found = predictor.linearise(window, x0, parameters);
  for (Eigen::Index i = 0; i < x0.size(); ++i) {
    const Eigen::VectorXd unit = kStep * Eigen::VectorXd::Unit(x0.size(), i);
    const Eigen::VectorXd below = predictor.residual(window, x0 - unit);
    const Eigen::VectorXd differences = (below - predictor.residual(window, x0 + unit)) / (2.0 * kStep);
    EXPECT_LT((found.Jx.col(i) - differences).norm(), kShare * differences.norm() + 1e-3) << "state " << i;
  }
  constexpr double kFloors = 0.1;  // what a parameter as large as it is does not move is noise
  int of_contact = 0;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    model::Plant& plant = predictor.plant();
    const double value = plant.value(parameters[p].id);
    const double change = 1e-3 * value;
    if (change == 0.0) {
      continue;
    }
    parameters[p].set(plant, value - change);
    const Eigen::VectorXd below = predictor.residual(window, x0);
    parameters[p].set(plant, value + change);
    const Eigen::VectorXd differences = (below - predictor.residual(window, x0)) / (2.0 * change);
    parameters[p].set(plant, value);
    if (differences.norm() * std::abs(value) < kFloors) {
      continue;
    }
    EXPECT_LT((found.Jp.col(static_cast<Eigen::Index>(p)) - differences).norm(), kShare * differences.norm())
        << parameters[p].label;
    of_contact +=
        plant.model().effects[static_cast<std::size_t>(parameters[p].id.effect)].at == "bump" ? 1 : 0;
  }
  EXPECT_GE(of_contact, 2);  // stiffness and damping at least
}

// A twin whose ball is a half stiffer than the model says, by two trials: the fit finds it within its
// interval.
TEST_F(Bumpers, AFitFindsTheStiffnessOfTheContact) {
  const model::Model truth = with_stiffness(1.5e5);
  std::vector<Trial> trials;
  for (const char* name : {"push", "swing"}) {
    trials.push_back(
        twin(truth, read_experiment(std::string(kFolder) + "experiments/" + name + ".yaml", truth), {}));
  }
  trials.front().name = trials.front().file = "push";
  trials.back().name = trials.back().file = "swing";
  const Data data(std::move(trials), {});
  const auto silent = [](const std::string& /*what*/, double /*fraction*/) {};
  const Fit found =
      fit(model_, data, matching(free_parameters(model_), {"ground_normal@bump:stiffness"}), {}, silent);
  ASSERT_EQ(found.parameters.size(), 1U);
  EXPECT_LT(std::abs(found.parameters[0].after - 1.5e5), 0.05 * 1.5e5);
  EXPECT_LE(found.parameters[0].lower, 1.5e5);
  EXPECT_GE(found.parameters[0].upper, 1.5e5);
}

}  // namespace
}  // namespace plumbline::validation
