// At which frequencies a residual is.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/report/thin.h"

namespace plumbline::validation {

/// One-sided amplitude density at k * frequency_step, k = 0, 1, ...: unit/sqrt(Hz).
struct Spectrum {
  double frequency_step = 0.0;  ///< Hz
  Eigen::VectorXd density;      ///< square root of the power density
};

/// Mean of Hann-windowed periodograms
///   S(f) = 2 T |sum_k w_k r_k exp(-2 pi i f k T)|^2 / sum_k w_k^2,
/// one for each span, so that the jumps between windows that were predicted by themselves stay out of it.
/// Spans are cut to the shortest of those that have at least half of the longest's samples; others are left
/// out. Source: P. D. Welch, IEEE Transactions on Audio and Electroacoustics 15 (1967) 70-73.
Spectrum spectrum(const Eigen::VectorXd& residual, const std::vector<Span>& spans, double period);

/// What white noise of this standard deviation has everywhere: floor * sqrt(2 T).
double density_of_floor(double floor, double period);

}  // namespace plumbline::validation
