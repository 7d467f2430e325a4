// How well the train windows foretell the held-out ones, given what they leave open of the parameters.
#pragma once

#include <vector>

#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {

/// Normal equations of the windows of one role, added up, initial states eliminated: in search units of the
/// parameters the sum of squares is cost(d) = sse - 2 g'd + d'H d.
struct Sum {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double sse = 0.0;      ///< after the initial states have moved
  double samples = 0.0;  ///< of all channels; 0: no window has this role
  double cost(const Eigen::VectorXd& d) const { return sse - 2.0 * g.dot(d) + d.dot(H * d); }
};
Sum sum_of(const std::vector<Reduced>& reduced, const std::vector<int>& windows, const Data& data, Role role);

/// With T(d) the train windows' cost and what is known beforehand, and V(d) the held-out windows' cost, the
/// held-out windows' error as the train windows foretell it is
///   min_d [T(d) + V(d)] - min_d T(d) = r' (I + J S J')^-1 r,
/// with r the held-out residuals at the step that is best for the train windows, J their slopes and S the
/// covariance that T leaves to d: the exponent of the predictive distribution, for residuals in units of
/// their deviation. It is at most V at that step, and equal to it where the train windows leave nothing open.
/// Source: Bishop, Pattern Recognition and Machine Learning, 2006, equations 3.58 and 3.59.
struct Foretold {
  Eigen::VectorXd train_step;  ///< best for the train windows
  Eigen::VectorXd step;        ///< best for all windows
  double train = 0.0;          ///< train windows' sum of squares after train_step
  double held_out = 0.0;       ///< what the formula gives
};
Foretold foretell(const Sum& train, const Sum& held_out, const Prior& known, const Room& bounds);

/// The values after a step in search units, within their bounds; one that would not be finite stays.
Eigen::VectorXd stepped(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                        const Eigen::VectorXd& units, const Eigen::VectorXd& step);

/// The squares of the windows with those of the held-out windows as they are foretold at a fit's end, where
/// the windows were reduced; `units`: of the reduction. A value of which nothing is known beforehand is
/// trusted to move by half a search unit, as far as a straight line serves.
Prediction prediction(const Data& data, const std::vector<Reduced>& reduced,
                      const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                      const Eigen::VectorXd& units);

}  // namespace plumbline::validation
