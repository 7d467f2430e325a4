// Standard identification held against predicted windows, for every robot whose windows can be followed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/identify/diagnose/screen.h"
#include "validation/identify/predict/deviations.h"
#include "validation/identify/standard/free_values.h"

namespace plumbline::validation {

struct WindowsFit {
  Stage stage;  ///< the model with all values of free_values(), fitted
  Precision precision;
  Scores scores;  ///< as compare() gives them of fitted_model(stage), floor units
  int values = 0, at_limits = 0;
};

/// All of free_values(), or those of the drives, at once, fitted to the windows of the train trials by
/// Gauss-Newton from the model as it is, and from `torques` where that starts better: masses, centres of
/// mass, rotor inertias, gains and offsets, viscous and Coulomb friction at motors and at passive joints.
/// What a model leaves is its error, not the sensors' noise, so that what is stated is weighed against
/// residuals r of the scale that is there,
///   min sum (r / f)^2 / s^2 + sum over values ((theta_i - stated_i) / spread_i)^2,
/// f the floors and s >= 1 the train error in floors, found again as it falls. Needs no torque of a passive
/// joint and no differentiation. Nothing where the robot has no motor, where the windows cannot be followed
/// to their end (reach.h) or cannot be integrated with so much freedom. Source: L. Ljung, System
/// Identification, 2nd ed. 1999, 7.2 and 7.4 (output error; what is known beforehand as a penalty).
std::optional<WindowsFit> standard_by_windows(const model::Model& model, Freed freed,
                                              const FreeModel* torques, const Data& data, std::size_t windows,
                                              const Progress& progress);

/// A value that the train windows tell from the stated one: it differs by more than two deviations.
struct ToldValue {
  std::string label, unit;  ///< "coulomb@knee:level"
  double stated = 0.0, value = 0.0, deviation = 0.0;
};

/// A kind of value that standard identification frees, and the error that counts (held-out where there is
/// one) with all of the kind as stated and the rest as identified.
struct KindShare {
  std::string kind;
  double without = 0.0;         ///< floor units; infinite where it cannot be integrated
  std::vector<ToldValue> told;  ///< of the kind, in the order of the model
};

/// Of masses, drives, offsets and friction, on the windows of `data`, the largest first.
std::vector<KindShare> kind_shares(const WindowsFit& fit, const Data& data);

/// A stage that was fitted to some of the windows, fitted to all. Throws where they cannot be integrated.
WindowsFit fitted_on_all(const Stage& stage, const Data& data);

/// The model with the values that the torques ask for, as they are, with the deviations that they state.
WindowsFit as_windows_fit(const FreeModel& torques, const Scores& scores);

}  // namespace plumbline::validation
