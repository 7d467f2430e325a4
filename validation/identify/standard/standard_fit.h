// Standard identification: linear least squares of the rigid-body regressor with friction and motor
// constants.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/diagnose/screen.h"
#include "validation/identify/predict/estimate.h"
#include "validation/identify/standard/free_values.h"

namespace plumbline::validation {

struct StandardOptions {
  double force_cutoff = 0.0;  ///< Hz: low-pass of torques and regressor; 0: chosen by prediction
};

/// Torque needed less delivered, over all used samples of the train trials.
struct TorqueError {
  std::string motor, unit;
  double recorded = 0.0;             ///< rms, N m or N
  double before = 0.0, after = 0.0;  ///< rms, likewise
};

struct StandardFit {
  FreeModel free;  ///< with the identified values
  std::vector<TorqueError> torques;
  Scores before, after;      ///< of predictions, floor units, as compare() gives them
  Eigen::Index samples = 0;  ///< of the train trials
  double cutoff = 0.0;       ///< Hz, of the first train trial
  int at_limits() const;
  int unseen() const;
};

/// Least squares of the torques on the train trials: the minimum of TorqueProblem over free_values(). A value
/// that changes no torque by more than 1e-6 of its rms for one spread stays as stated. Encoders that are
/// differenced twice say little of fast torques, and their noise in the regressor makes values too small.
/// How much lies below which frequency depends on machine and log; so cutoffs of 40 Hz, halved down to one
/// period in a window, are tried, and the values are those that predict the train windows best. Deviations
/// hold the errors e for noise: where the model lacks something else they are too small. Throws InputError as
/// TorqueProblem does.
/// Source: Atkeson, An and Hollerbach, Int. J. of Robotics Research 5(3), 1986 (regressor of links); Gautier
/// and Khalil, Exciting trajectories for the identification of base inertial parameters of robots, Int. J. of
/// Robotics Research 11(4), 1992; Swevers et al., Optimal robot excitation and identification, IEEE Trans.
/// Robotics and Automation 13(5), 1997 (weights by the torques' noise).
StandardFit standard_fit(const model::Model& model, const Data& data, const StandardOptions& options,
                         const Progress& progress);

}  // namespace plumbline::validation
