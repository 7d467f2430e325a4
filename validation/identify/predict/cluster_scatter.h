// How sure an estimate is, from the scatter of the windows that it was made of.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {

struct Scatter {
  Eigen::MatrixXd inverse;  ///< H^-1
  Eigen::MatrixXd covariance;
  Eigen::VectorXd freedom;  ///< degrees of freedom behind each diagonal entry of `covariance`
};

/// Covariance of the estimate H^-1 sum J'y with H = sum J'J + known (J with the initial state projected
/// out), whose windows' residuals may be correlated in themselves but not with each other's:
///   H^-1 (sum a a' + known + others) H^-1,  a = L (1 - L^-1 H_w L^-T)^(-1/2) L^-1 g_w,  H = L L'
/// The square root makes up for what the fit has taken off each window's residuals: little where a window
/// tells little, much where it decides. `known`: precision of what is known beforehand, which errs by as much
/// as it says; `others`: covariance of the scores' part that scatter between windows does not show. The
/// degrees of freedom are those of a chi-squared of the same mean and variance, for white residuals: windows
/// that tell nothing of a parameter do not count for it. Source: Bell and McCaffrey, Bias reduction in
/// standard errors for linear regression with multi-stage samples, Survey Methodology 28 (2002) 169-181 (CR2
/// and its degrees of freedom); Satterthwaite, Biometrics Bulletin 2 (1946) 110-114, for the sum with what is
/// known.
Scatter cluster_scatter(const std::vector<Reduced>& windows, const Eigen::MatrixXd& known,
                        const Eigen::MatrixXd& others);

}  // namespace plumbline::validation
