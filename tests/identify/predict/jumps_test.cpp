// Derivatives of windows in which a force jumps: the damping of a stop, of play that closes.
#include <gtest/gtest.h>

#include "tests/identify/predict/hopper.h"
#include "validation/identify/fit/free_parameters.h"

namespace plumbline::validation {
namespace {

class Jumps : public testing::Test {
 protected:
  static model::Model pendulum(const std::string& effect) {
    model::Model model = model::read_model(std::string(PLUMBLINE_ROOT) + "/tests/robots/pendulum/model.yaml",
                                           model::known_effects());
    model.effects.push_back(parse_effect(effect, model, model::known_effects()));
    return model;
  }

  static Trial steps_of(const model::Model& model) {
    const std::string file = std::string(PLUMBLINE_ROOT) + "/tests/robots/pendulum/experiments/steps.yaml";
    return twin(model, read_experiment(file, model), {});
  }

  /// Within `share` of each derivative that matters. The oracle is differences of whole predictions: the
  /// variational equations know nothing of them.
  static void agree_with_differences(const std::string& effect, const Window& window, double share,
                                     double step = 1e-5) {
    const model::Model model = pendulum(effect);
    const Trial trial = steps_of(model);
    const std::vector<FreeParameter> parameters = free_parameters(model);
    PredictOptions options;
    options.relative_tolerance = 1e-11;
    options.method = integrate::Method::rosenbrock;
    Predictor predictor(model, trial, options);
    const Eigen::VectorXd x0 = predictor.initial_state(window);
    const Linearisation found = predictor.linearise(window, x0, parameters);
    const auto compare = [share](const Eigen::VectorXd& one, const Eigen::VectorXd& two,
                                 const std::string& what) {
      EXPECT_LT((one - two).norm(), share * two.norm()) << what;
    };
    for (Eigen::Index i = 0; i < x0.size(); ++i) {
      const Eigen::VectorXd unit = step * Eigen::VectorXd::Unit(x0.size(), i);
      const Eigen::VectorXd below = predictor.residual(window, x0 - unit);
      compare(found.Jx.col(i), (below - predictor.residual(window, x0 + unit)) / (2.0 * step),
              "state " + std::to_string(i));
    }
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      model::Plant& plant = predictor.plant();
      const double value = plant.value(parameters[p].id);
      const double change = 10.0 * step * std::abs(value);
      if (change == 0.0) {
        continue;
      }
      parameters[p].set(plant, value - change);
      const Eigen::VectorXd below = predictor.residual(window, x0);
      parameters[p].set(plant, value + change);
      const Eigen::VectorXd above = predictor.residual(window, x0);
      parameters[p].set(plant, value);
      const Eigen::VectorXd differences = (below - above) / (2.0 * change);
      constexpr double kFloors = 0.1;  // what a parameter as large as it is does not move is noise
      if (differences.norm() * std::abs(value) > kFloors) {
        compare(found.Jp.col(static_cast<Eigen::Index>(p)), differences, parameters[p].label);
      }
    }
  }
};

TEST_F(Jumps, AtAStopTheDerivativesAgreeWithDifferences) {
  agree_with_differences("hard_stop@shoulder:cubic_stiffness=4000,damping=40,position=0.1,side=1,pulls=1",
                         {0, 200, 300, {}}, 0.03);
}

// Where the surfaces part the force bends with position and speed. (One that holds at once is known by
// differences only: the straight line through such a sample has the stop let go of half of it.)
TEST_F(Jumps, AtAStopThatNeverPullsTheDerivativesAgreeWithDifferences) {
  agree_with_differences("hard_stop@shoulder:stiffness=300,damping=4,position=0.1,side=1,pulls=0",
                         {0, 200, 300, {}}, 0.03);
}

// A stop that brings the motion to rest within a thousandth of a sample; and one that lets go of it at a
// two-thousandth of the speed at which it was met.
TEST_F(Jumps, AtAStopThatHoldsAtOnceTheDerivativesAgreeWithDifferences) {
  const Window meets{0, 200, 300, {}};
  agree_with_differences("hard_stop@shoulder:cubic_stiffness=4000,damping=400000,position=0.1,side=1,pulls=1",
                         meets, 0.03);
  const Window leaves{0, 780, 600, {}};
  agree_with_differences("hard_stop@shoulder:cubic_stiffness=4000,damping=4000,position=0.1,side=1,pulls=1",
                         leaves, 0.03, 1e-8);
}

TEST_F(Jumps, WherePlayClosesTheDerivativesAgreeWithDifferences) {
  agree_with_differences("backlash@shoulder:gap=0.02,stiffness=300,damping=4", {0, 190, 160, {}}, 0.1);
  // Soft: a sample's mean motion in contact is that of a cubic, and the damping shows by it.
  agree_with_differences("backlash@shoulder:gap=0.02,stiffness=30,damping=0.1", {0, 190, 160, {}}, 0.2);
}

// The hopper's carriage is seen by no sensor: with play in its ratio nothing says where in the play it is.
TEST(HiddenPlay, BeginsWhereTheMotorHasItIfItWereRigid) {
  const model::Model rigid = test::hopper();
  const Trial trial = test::hopper_trial(rigid, "bounce");
  model::Model played = rigid;
  played.effects.push_back(
      parse_effect("backlash@carriage:gap=0.004,stiffness=17,damping=0.03", played, model::known_effects()));
  const Window window{0, 0, 100, {}};
  constexpr int kCarriage = 1;
  Predictor without(rigid, trial, {});
  Predictor with(played, trial, {});
  constexpr double kRatio = 50.0;  // rad/m
  const double start = without.initial_state(window)[kCarriage];
  EXPECT_NEAR(with.initial_state(window)[kCarriage], start, 0.004 / kRatio) << "m, by no more than the play";
}

}  // namespace
}  // namespace plumbline::validation
