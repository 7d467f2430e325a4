// Parameters from recordings simulated in one piece, without derivatives: for motions through many impacts.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/fit/fit.h"

namespace plumbline::validation {

/// Error of one recording: root mean square over the channels of their root mean square residuals, floors.
/// `predicted`: samples x channels, SI; where it has fewer samples than the window its last ones are held.
double error_of_motion(const Predictor& predictor, const Trial& trial, const Window& window,
                       const Eigen::MatrixXd& predicted);

/// Minimises the mean over the train recordings of their errors,
///   J(theta) = 1/n sum_i e_i(theta),  e_i^2 = 1/C sum_c mean_k ((y - y_hat(x0_i, theta)) / f_c)^2,
/// each simulated from its first to its last sample (output error) from a state that its first samples give,
/// once for all theta (flight_start.h). Through impacts a deviation grows with every landing: slopes promise
/// what no step keeps, or are not finite, while the mean over many recordings still has a broad minimum.
/// CMA-ES needs the order of costs alone (optimise/cma_search.h). A mean, not a mean square: the recordings
/// that end on another side of the robot, by chance, do not decide.
///
/// How sure: from the sets that the search tried, by the bootstrap over recordings (Efron, Annals of
/// Statistics 7, 1979, 1-26): the recordings are drawn with replacement and the best set of each draw taken;
/// interval and standard deviation are those of 1000 draws. Values between the sets that were tried are not
/// seen, so that an interval is no finer than they are dense.
///
/// options.iterations: most generations of the search; it ends earlier when ten of them have gained less than
/// a thousandth. Deterministic. Throws InputError without a train trial, or where a parameter cannot leave
/// its null value.
Fit fit_whole(const model::Model& model, const Data& data, std::vector<FreeParameter> parameters,
              const FitOptions& options, const Progress& progress);

}  // namespace plumbline::validation
