// Predictions of a force plate, where it is all that was measured.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/estimate.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

class ForcePlate : public testing::Test {
 protected:
  static model::Model spring_mass() {
    return model::read_model(std::string(PLUMBLINE_ROOT) + "/robots/atrias/spring_mass.yaml",
                             model::known_effects());
  }
  /// The body bounces on the plate, which alone is recorded; the leg is known to be at rest in flight.
  static Trial bounces(const model::Model& truth, const std::string& experiment) {
    const std::string folder = std::string(PLUMBLINE_ROOT) + "/robots/atrias/experiments/";
    Trial trial = twin(truth, read_experiment(folder + experiment + ".yaml", truth), {});
    trial.file = trial.name = experiment;
    trial.start = {{"height", 1.14, 5e-3}, {"leg", 0.0, 1e-6}};
    return trial;
  }
  static Window stance(const Trial& trial) {
    for (const Window& window : cut_windows({trial}, {})) {
      if (window.events.size() == 2 && flight_at(trial, window.first)) {
        return window;
      }
    }
    throw std::runtime_error("no stance between two flights");
  }
  static model::Model with(model::Model model, const std::string& effect) {
    model.effects.push_back(parse_effect(effect, model, model::known_effects()));
    return model;
  }

  const model::Model model_ = spring_mass();
};

// The oracle is the momentum: m (v1 - v0) = integral of (F - m g) over a stance.
TEST_F(ForcePlate, ReadsWhatChangesTheMomentum) {
  const Trial trial = bounces(model_, "drop");
  const Window window = stance(trial);
  PredictOptions options;
  options.relative_tolerance = 1e-8;
  Predictor predictor(model_, trial, options);
  const Eigen::VectorXd force = predictor.predict(window, predictor.initial_state(window)).col(0);
  const Eigen::MatrixXd states = predictor.predicted_states();
  const Eigen::Index last = force.size() - 1;
  // Body and foot: z is the body's height and the leg's shortening, which lifts the foot.
  const double body = 64.0;
  const double foot = 0.1;
  const auto momentum = [&](Eigen::Index k) { return (body + foot) * states(2, k) + foot * states(3, k); };
  const double impulse = trial.period * force.tail(last).sum();
  const double time = trial.period * static_cast<double>(last);
  const double weight = (body + foot) * model_.skeleton.gravity.norm();
  EXPECT_NEAR(impulse - weight * time, momentum(last) - momentum(0), 0.01 * weight * time);
  EXPECT_EQ(force[0], 0.0);
  EXPECT_GT(force.maxCoeff(), weight);
}

// A window begins in the flight before the touchdown, and its touchdown comes when the plate says.
TEST_F(ForcePlate, AWindowBeginsWhereTheFlightLeads) {
  const Trial trial = bounces(model_, "drop");
  Predictor predictor(model_, trial, {});
  const Window window = stance(trial);
  const Flight flight = *flight_at(trial, window.first);
  const Eigen::VectorXd x0 = predictor.initial_state(window);
  const double g = model_.skeleton.gravity.norm();
  const double middle = 0.5 * (flight.lift_off + flight.touchdown);
  EXPECT_NEAR(x0[2], -g * (trial.time[window.first] - middle), 0.02);
  const Eigen::VectorXd r = predictor.residual(window, x0);
  const Eigen::Index touchdown = window.count * predictor.channels();
  EXPECT_LT(std::abs(r[touchdown] * timing_floor(trial)), 1e-4);
}

// The oracle is differences of whole predictions: the variational equations know nothing of them.
TEST_F(ForcePlate, HasTheSlopesOfItsPredictions) {
  const Trial trial = bounces(model_, "drop");
  const Window window = stance(trial);
  const model::Model model =
      with(with(model_, "added_mass@body:mass=1"), "hysteresis@leg:loss=500,rest=0.05");
  const std::vector<FreeParameter> parameters =
      matching(free_parameters(model), {"added_mass@*", "hysteresis@leg:*", "spring@leg:stiffness",
                                        "viscous@leg:damping", "ground_normal@toe:stiffness"});
  PredictOptions options;
  Predictor predictor(model, trial, options);
  options.relative_tolerance = 1e-9;
  Predictor exact(model, trial, options);
  const Eigen::VectorXd x0 = predictor.initial_state(window);
  const Linearisation found = predictor.linearise(window, x0, parameters);
  const auto agree = [](const Eigen::VectorXd& slope, const Eigen::VectorXd& oracle, const std::string& of) {
    EXPECT_LT((slope - oracle).norm(), 0.03 * oracle.norm()) << of;
  };
  // The body's height and speed. (The leg begins at its stop, where slopes to either side differ.)
  for (const Eigen::Index i : {0, 2}) {
    const Eigen::VectorXd step = Eigen::VectorXd::Unit(x0.size(), i) * (i < 2 ? 1e-7 : 1e-5);
    const Eigen::VectorXd rise = exact.residual(window, x0 - step) - exact.residual(window, x0 + step);
    agree(found.Jx.col(i), rise / (2.0 * step[i]), "state " + std::to_string(i));
  }
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double here = exact.plant().value(parameters[p].id);
    const double step = 1e-4 * here;
    parameters[p].set(exact.plant(), here + step);
    const Eigen::VectorXd above = exact.residual(window, x0);
    parameters[p].set(exact.plant(), here - step);
    const Eigen::VectorXd below = exact.residual(window, x0);
    parameters[p].set(exact.plant(), here);
    agree(found.Jp.col(static_cast<Eigen::Index>(p)), (below - above) / (2.0 * step), parameters[p].label);
  }
}

TEST_F(ForcePlate, TellsTheMassAndTheStiffness) {
  const Data data({bounces(with(model_, "added_mass@body:mass=4"), "drop")}, {});
  const model::Model wrong = with(model_, "added_mass@body");
  const std::vector<FreeParameter> mass = matching(free_parameters(wrong), {"added_mass@body:mass"});
  std::vector<FreeParameter> free = matching(free_parameters(wrong), {"spring@leg:stiffness"});
  free.push_back(mass.front());
  PredictorPool pool(wrong, data);
  const Estimate found = gauss_newton(pool, free, Eigen::Vector2d(14000.0, 0.0), {}, {12, 1e-4});
  EXPECT_NEAR(found.theta[0], 16000.0, 160.0);
  EXPECT_NEAR(found.theta[1], 4.0, 0.3);
  EXPECT_LT(found.scores.train, 3.0);
}

}  // namespace
}  // namespace plumbline::validation
