// The numbers of chapters 6 and 7 beside those that the thesis prints, as text.
#pragma once

#include <string>

#include "validation/studies/spring_mass/stance_theory.h"

namespace plumbline::spring_mass {

/// The weights that the group's repository states for the experiments
/// (github.com/williamcmartin/atrias-controller, 25326a2 and d619fec, control_params.m): vertical Q =
/// diag(100, 1), R = 2.5e-6; sagittal Q = diag(1, 1, 25, 1) and H = diag(0, 0, 5, 0.03) for x, its rate,
/// pitch and its rate, R = 0.4e-4.
Weights<2, 1> published_vertical_weights(double factor_of_r = 1.0);
Weights<4, 1> published_sagittal_weights();
Matrix<4, 4> published_sagittal_penalty();

/// T_s of equation 6.9 as printed; of the infinite one entry (3,1) as its printed product and eigenvalues
/// ask: 0.06, not 0.66.
Matrix<4, 4> printed_finite_stance();
Matrix<4, 4> printed_infinite_stance();

/// Horizontal placement that cancels what pitch does to the speed: row of gains on the error at lift-off
/// (equation 6.11).
Matrix<1, 4> deadbeat_adjustment(const Matrix<4, 4>& stance, const Matrix<4, 4>& flight);

/// Everything, with the printed value beside ours.
std::string theory_report(const Gait& gait);

}  // namespace plumbline::spring_mass
