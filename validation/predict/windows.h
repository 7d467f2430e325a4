// Windows of trials, and the prediction of one window from an initial state with all its derivatives.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "simulator/integrate/held_commands.h"
#include "simulator/integrate/integrator.h"
#include "simulator/model/plant.h"
#include "simulator/model/positions_from.h"
#include "validation/trial/trial.h"

namespace plumbline::validation {

/// Samples first ... first + count - 1 of a trial, predicted from their own initial state.
struct Window {
  int trial = 0;
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

struct PredictOptions {
  double window = 0.5;  ///< s
  double relative_tolerance = 1e-5;
  double history = 1.0;  ///< s of measured motion before a window over which hidden states are carried
  /// Integrator steps for each sample, mean over a window; a law that needs more: std::runtime_error.
  double most_steps = std::numeric_limits<double>::infinity();
  /// explicit_rk runs at order 3: one step for each held sample, four evaluations, errors far below any
  /// encoder's count. A stiff ground wants rosenbrock.
  integrate::Method method = integrate::Method::explicit_rk;
  /// Derivatives by differences of whole predictions: slower, but right where a window runs through touchdown
  /// and lift-off, and for the parameters of the ground.
  bool differences = false;
  int refresh = 8;  ///< samples between refreshes of the rigid linearisation
};

/// Cuts every trial into equal windows of about options.window, never across an event; a rest shorter than
/// half a window joins its neighbour. Throws InputError when a trial has fewer samples than one window.
std::vector<Window> cut_windows(const std::vector<Trial>& trials, const PredictOptions& options);

/// One parameter that may move.
struct FreeParameter {
  model::ParameterId id;
  std::string label;  ///< "viscous@mLA:damping"
  std::string unit;
  effects::Scale scale = effects::Scale::linear;
  double lower = 0.0, upper = 0.0;  ///< in the parameter's own unit
  double typical = 1.0;
  double mean = 0.0;                                           ///< what is known of it beforehand
  double deviation = std::numeric_limits<double>::infinity();  ///< and how well; infinite: not at all
  std::vector<model::ParameterId> also{};                      ///< parameters that always have the same value

  void set(model::Plant& plant, double value) const;
};

/// The window's residual r = (measured - predicted) / floor, channel by channel within each sample, and
/// Jx = d(predicted)/d(x0) / floor, Jp = d(predicted)/d(parameters) / floor.
struct Linearisation {
  Eigen::VectorXd r;
  Eigen::MatrixXd Jx, Jp;
};

/// Predicts windows of one trial with one model. Owns a Plant: one object for each thread.
class Predictor {
 public:
  Predictor(const model::Model& model, const Trial& trial, const PredictOptions& options);

  model::Plant& plant() { return plant_; }
  int channels() const { return static_cast<int>(sensor_of_channel_.size()); }
  const Eigen::VectorXd& floors() const { return floors_; }

  /// State at the window's start from the measurements alone: positions by weighted least squares over the
  /// first samples' local polynomials, unseen stretches zero, actuators settled, bristles relaxed.
  /// A prediction does not start from these bristles: it carries them along the measured motion up to the
  /// window with the parameters of the moment. Free in each window they would be a force of their own, and a
  /// friction law would explain whatever is constant over a window.
  Eigen::VectorXd initial_state(const Window& window);
  /// One standard deviation within which the initial state is expected around initial_state().
  Eigen::VectorXd initial_spread(const Window& window);

  /// Predicted channels, count x channels, SI.
  Eigen::MatrixXd predict(const Window& window, const Eigen::VectorXd& x0);
  /// States of the window predicted last, states x count.
  const Eigen::MatrixXd& predicted_states() const { return states_; }
  /// Independent positions that fit the measured channels best, positions x samples of the trial.
  Eigen::MatrixXd measured_positions() const;
  /// Residuals only.
  Eigen::VectorXd residual(const Window& window, const Eigen::VectorXd& x0);
  Linearisation linearise(const Window& window, const Eigen::VectorXd& x0,
                          const std::vector<FreeParameter>& parameters);
  /// Residual of a window for predicted channels.
  Eigen::VectorXd residual_of(const Window& window, const Eigen::MatrixXd& predicted) const;
  /// Rate evaluations so far.
  long evaluations() const { return evaluations_; }

 private:
  void run(const Window& window, const Eigen::VectorXd& x0);
  Linearisation linearise_tied(const Window& window, const Eigen::VectorXd& x0,
                               const std::vector<FreeParameter>& parameters);
  Linearisation linearise_by_differences(const Window& window, const Eigen::VectorXd& x0,
                                         const std::vector<FreeParameter>& parameters);
  void refresh_commands();
  void tangent_at(const Window& window, Eigen::Index k, const std::vector<model::ParameterId>& ids,
                  const Eigen::VectorXd& steps, bool refresh, Eigen::MatrixXd& A, Eigen::MatrixXd& B);
  Eigen::MatrixXd local_polynomial(const Window& window) const;
  void measure_motion();
  void carry_hidden(const Window& window, double* x);
  Eigen::MatrixXd hidden_slopes(const Window& window, const std::vector<model::ParameterId>& ids,
                                const Eigen::VectorXd& steps);

  const Trial& trial_;
  PredictOptions options_;
  model::Plant plant_;
  std::vector<int> sensor_of_channel_;
  Eigen::VectorXd floors_;
  model::PositionsFrom from_channels_;
  Eigen::MatrixXd command_samples_;
  std::unique_ptr<integrate::HeldCommands> commands_;
  Eigen::MatrixXd states_;  // states x count of the last run
  Eigen::MatrixXd motion_;  // positions and velocities x samples, measured; empty until it is needed
  long evaluations_ = 0;
};

}  // namespace plumbline::validation
