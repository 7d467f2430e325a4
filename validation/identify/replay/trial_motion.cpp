#include "validation/identify/replay/trial_motion.h"

#include "validation/identify/predict/flight_start.h"

namespace plumbline::validation {
namespace {

std::vector<Window> windows_of(const Trial& trial, const PredictOptions& predict, bool whole) {
  if (whole) {
    return {{0, 0, trial.samples()}};
  }
  return cut_windows({trial}, predict);
}

void add_forces(model::Plant& plant, const Eigen::MatrixXd& states, Eigen::Index first, TrialMotion& motion) {
  for (Eigen::Index k = 0; k < states.cols() && !motion.foot_forces.empty(); ++k) {
    const std::vector<model::Touch> touches = plant.touches(states.col(k).data());
    for (std::size_t f = 0; f < touches.size(); ++f) {
      motion.foot_forces[f].col(first + k) = touches[f].force;
    }
  }
}

}  // namespace

TrialMotion trial_motion(const model::Model& model, const Trial& trial, const TrialMotionOptions& options) {
  PredictOptions predict;
  const bool whole = options.window <= 0.0;
  predict.window = whole ? predict.window : options.window;
  if (!model.feet.empty()) {
    predict.method = integrate::Method::rosenbrock;
  }
  Predictor predictor(model, trial, predict);
  TrialMotion motion;
  motion.time = trial.time;
  motion.measured = predictor.measured_positions();
  motion.predicted = motion.measured;  // windows too short to predict stay as measured
  motion.foot_forces.assign(model.feet.size(), Eigen::Matrix3Xd::Zero(3, trial.samples()));
  for (const Window& window : windows_of(trial, predict, whole)) {
    if (options.stop != nullptr && options.stop->raised) {
      throw Stopped();
    }
    predictor.predict(window, state_at_start(predictor, trial, window));
    const Eigen::MatrixXd states = predictor.predicted_states();
    motion.predicted.middleCols(window.first, window.count) = states.topRows(predictor.plant().positions());
    add_forces(predictor.plant(), states, window.first, motion);
  }
  return motion;
}

}  // namespace plumbline::validation
