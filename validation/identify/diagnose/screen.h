// The score test: how much of the error each candidate could explain, after the model's own free parameters
// and every window's initial state have explained what they can.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/identify/diagnose/candidates.h"

namespace plumbline::validation {

/// What a step of the diagnosis works on: the model so far and its estimate.
struct Stage {
  model::Model model;
  std::vector<FreeParameter> parameters;
  Estimate estimate;
};

/// The stage's model with the values that its fit ended at.
model::Model fitted_model(const Stage& stage);

/// The stage with its parameters fitted anew from its model's values, and initial states from x0 or, where
/// that is empty, from the measurements. The fit ends where the cost changes by less than `tolerance` of it.
Stage fitted_anew(Stage stage, const Data& data, const std::vector<Eigen::VectorXd>& x0 = {},
                  double tolerance = 1e-3);

/// A candidate with the values from which it is tried, and what the linearised windows promise.
struct Hypothesis {
  int candidate = 0;
  effects::Values start;
  double promised_train = 0.0;  ///< mean squares in floor units (1: the floor)
  double promised_held_out = 0.0;
  Eigen::VectorXd step;  ///< promised change: stage parameters, then the candidate's (search units)
  std::vector<Eigen::VectorXd> x0;  ///< promised initial states; empty where the state has grown
  bool tangent = true;              ///< linearised at the null value; otherwise at `start`
  double promised() const { return promised_train + promised_held_out; }
};

/// Best promise first; what is equal stays in its order.
void sort_by_promise(std::vector<Hypothesis>& hypotheses);

using Progress = std::function<void(const std::string& what, double fraction)>;

/// Best promise first. Every candidate that moves the prediction at all is in the list.
std::vector<Hypothesis> screen(const Stage& stage, const std::vector<Candidate>& candidates, const Data& data,
                               const Progress& progress);

/// The stage's model with the candidate added at these values; parameters: the stage's, then the candidate's.
struct Extended {
  model::Model model;
  std::vector<FreeParameter> parameters;
  Eigen::VectorXd theta;
};
Extended extend(const Stage& stage, const Candidate& candidate, const effects::Values& values);

/// The extended model's values at the hypothesis' start, moved by what it promises, within bounds.
Eigen::VectorXd promised_theta(const Extended& extended, const Hypothesis& hypothesis);

}  // namespace plumbline::validation
