// Least-squares estimates over windows: parameters shared by all, an initial state for each.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// Root mean square over the channels of (rms residual / floor), for the windows of one role.
/// 1 is what the sensors alone leave.
struct Scores {
  double train = 0.0;
  double held_out = 0.0;
  double test = 0.0;  ///< of an estimate of Data::of_tests() only (test_error below)
  double square() const { return train * train + held_out * held_out; }
};

/// The held-out windows as the train windows foretell them with what these leave open of the parameters
/// (foretell.h), the train windows as they are.
struct Prediction {
  Eigen::VectorXd theta;  ///< the values, of those that the train windows leave open, that serve all windows
  std::vector<Eigen::VectorXd> square;  ///< as in Estimate
  Scores scores;
};

struct Estimate {
  Eigen::VectorXd theta;            ///< parameter values in their own units
  std::vector<Eigen::VectorXd> x0;  ///< by window
  /// By window: sum of squared residuals of each channel, then of each contact switch, floor units.
  std::vector<Eigen::VectorXd> square;
  Scores scores;
  Prediction predicted;  ///< gauss_newton only
  double cost =
      0.0;  ///< gauss_newton: squared residuals of the train windows and of what is known beforehand
  int iterations = 0;
  bool converged = false;  ///< more iterations would gain nothing
};

struct EstimateOptions {
  int iterations = 12;
  double tolerance = 1e-4;  ///< relative change of the cost at which it stops
  bool by_parts = true;     ///< gauss_newton: with stops or play also on the windows' beginnings first
};

/// Ceres: minimises the squared residuals of the train windows over theta (within bounds) and each window's
/// initial state; then, with theta fixed, the initial states of the held-out windows.
/// start_x0 may be empty (from the measurements). A window that cannot be integrated at the end has an
/// infinite error, and so has its role.
Estimate estimate(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                  const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& start_x0,
                  const EstimateOptions& options);

/// The estimate with what is known beforehand (Prior), by Gauss-Newton steps on the reduced equations, for
/// many models in a short time: one pass over the windows gives the step of the parameters and of all initial
/// states, held-out ones included. Steps that raise the cost are shortened. Stops when a step promises less
/// than options.tolerance of the cost, when no step helps, or when three in a row have gained less than that.
/// With stops or play the error over a long window has many minima: initial states come from short beginnings
/// of the windows, then longer ones, each from where the one before ended; and where the error then stays
/// above the floor, the parameters too, if that is better. Throws std::runtime_error when the model cannot be
/// integrated from the start values.
Estimate gauss_newton(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                      const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& start_x0,
                      const EstimateOptions& options);

/// The same; where the model cannot be integrated from the start values nothing is searched, and a window
/// that cannot be followed has an infinite error, as in `estimate`, and so have its role and the cost.
Estimate try_gauss_newton(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                          const Eigen::VectorXd& start, const std::vector<Eigen::VectorXd>& start_x0,
                          const EstimateOptions& options);

/// The model as it is: try_gauss_newton without parameters, which finds the windows' initial states, from
/// start_x0 or, where that is empty, from the measurements.
Estimate estimate_states(PredictorPool& pool, const std::vector<Eigen::VectorXd>& start_x0 = {});

/// Can the model be integrated on all windows as it was found?
bool is_finite(const Estimate& estimate);

/// Squared residuals, as in Estimate, of windows that begin with these states; infinite where a window cannot
/// be integrated.
std::vector<Eigen::VectorXd> squares(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                     const Eigen::VectorXd& theta, const std::vector<Eigen::VectorXd>& x0);

/// Error of the model as it is on the trials of role test, in floors, as in Scores; 0 without such trials.
double test_error(const model::Model& model, const Data& data);

/// Scores of per-window squares: mean over samples for each channel, then root mean square over channels.
Scores score(const Data& data, const std::vector<Eigen::VectorXd>& square);

/// Readings of a window: samples times measured channels, one residual each.
double readings(const Data& data, int window);

/// Normal equations of one window with its initial state eliminated (Schur complement through QR), in the
/// search coordinates of the parameters scaled by `unit`: cost(delta) = sse - 2 g'delta + delta' H delta.
struct Reduced {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double sse = 0.0;      ///< after the initial state has moved; with how far it is from where it is expected
  double raw_sse = 0.0;  ///< before
  bool curved = false;   ///< far from linear in where it begins: through contact, stops or play
  double expansion = 0.0;   ///< Predictor::expansion
  Eigen::VectorXd square;   ///< sse by channel
  Eigen::VectorXd x_shift;  ///< change of the initial state at delta = 0
  Eigen::MatrixXd x_slope;  ///< its change with delta: x0 + x_shift - x_slope delta
  Eigen::MatrixXd x_H;      ///< J'J of the initial state, with what is known of it: x_H x_shift = J'r
  /// J with the initial state projected out, summed over each channel's samples; parameters x channels.
  Eigen::MatrixXd channel_slopes;
};

/// Columns are d/d(search) of the parameters that are `moving`, times `slopes` (search_slopes). Throws
/// std::runtime_error where the window cannot be integrated from x0.
Reduced reduce(Predictor& predictor, const Window& window, const Eigen::VectorXd& x0,
               const std::vector<FreeParameter>& moving, const Eigen::VectorXd& slopes);

/// One for each window in `windows`; columns are d/d(search)/unit. With empty units the parameters have the
/// values theta and no columns.
std::vector<Reduced> reduce(PredictorPool& pool, const std::vector<int>& windows,
                            const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                            const std::vector<Eigen::VectorXd>& x0, const Eigen::VectorXd& units);

/// Size of a step of each parameter's search coordinate that matters (from its typical value).
Eigen::VectorXd search_units(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta);

/// d(value)/d(search/unit) of each parameter at theta.
Eigen::VectorXd search_slopes(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& units,
                              const Eigen::VectorXd& theta);

/// What is known of the parameters beforehand, d' C^-1 d with d = (theta - mean) / deviation and C how these
/// hang together (FreeParameter::together): its value, and what it adds to g and H in the same search
/// coordinates. The data's own residuals are in units of the floor, so that the sum of both is minus twice a
/// log posterior.
struct Prior {
  double square = 0.0;
  Eigen::VectorXd g;
  Eigen::MatrixXd H;
};
Prior prior(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& units,
            const Eigen::VectorXd& theta);

/// C of those of which something is known, in their order.
Eigen::MatrixXd known_correlation(const std::vector<FreeParameter>& parameters);

/// Room that each parameter has within its bounds, in search units from theta.
struct Room {
  Eigen::VectorXd lower, upper;
};
Room room(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
          const Eigen::VectorXd& units);

}  // namespace plumbline::validation
