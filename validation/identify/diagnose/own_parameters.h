// What the model itself leaves open: numbers stated with an uncertainty. An effect has to beat them.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/diagnose/screen.h"

namespace plumbline::validation {

/// The model with an effect at its null value for every mass, rotor inertia and torque constant that states
/// an uncertainty: added_mass, rotor_inertia and torque_constant_error, with that uncertainty. It moves as
/// the model does, and what an honest change of these numbers can do is then a matter of these effects'
/// values. Uncertainties of further inertias at a motor count with the rotor's (root of the sum of squares).
/// Where the model has such an effect already the number was identified: that value and its uncertainty
/// replace what was stated before, and nothing further is opened. The model's last `named` effects stay the
/// last.
model::Model with_stated_errors(const model::Model& model, std::size_t named = 0);

/// The model's own free parameters: those of its effects that state an uncertainty, within `width` standard
/// deviations of the stated value and the law's bounds.
std::vector<FreeParameter> stated_parameters(const model::Model& model, double width);

/// Without those that could not move the prediction of the train windows by a noticeable share of the floor
/// within what is stated of them, at the values and initial states of `given`.
std::vector<FreeParameter> noticeable_parameters(PredictorPool& pool,
                                                 const std::vector<FreeParameter>& parameters,
                                                 const std::vector<Eigen::VectorXd>& x0);

/// The stage with its model's own numbers open beside its parameters: with_stated_errors, where none is open
/// yet, and of stated_parameters those that are noticeable in `data`. All stand where they stood; nothing is
/// fitted. The last `named` effects of the model stay the last.
Stage with_open_numbers(const Stage& stage, std::size_t named, double width, const Data& data);

/// How much more probable the data are with every own parameter exactly as stated than with them scattered as
/// what is stated of them says, natural logarithm (Savage-Dickey density ratio): with the own parameters d
/// from what is stated, in stated deviations, C how these hang together (FreeParameter::together), and S and
/// g their normal equations there, all others eliminated,
///   log B = (log det C + log det(C^-1 + S) - m' (C^-1 + S) m) / 2,  (C^-1 + S) m = g + S d.
/// Above zero the data speak for the stated numbers. The stage's own numbers are as stated (d = 0), or some
/// of them are among its parameters and stand where they were fitted; the others count for nothing then.
/// Source: Dickey, Annals of Mathematical Statistics 42, 1971; Kass and Raftery, J. American Statistical
/// Association 90, 1995.
double evidence_for_stated(const Stage& stage, const Data& data, double width);

/// An own parameter as it was fitted.
struct OwnParameter {
  std::string label, unit;  ///< "torque_constant_error@mLA:scale"
  double stated = 0.0, stated_deviation = 0.0;
  double value = 0.0;
  /// Distance from the stated value in stated standard deviations.
  double shift() const { return stated_deviation > 0.0 ? (value - stated) / stated_deviation : 0.0; }
};

/// The own parameters among a stage's: those of which something is known beforehand.
std::vector<OwnParameter> own_values(const Stage& stage);

}  // namespace plumbline::validation
