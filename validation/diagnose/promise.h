// Sums of the windows' normal equations by role, and what a step on a few of their unknowns promises.
#pragma once

#include <vector>

#include "validation/predict/estimate.h"

namespace plumbline::validation {

/// Normal equations of the windows of one role, added up.
struct Sum {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double sse = 0.0;      ///< after the initial states have moved
  double samples = 0.0;  ///< of all channels
};
Sum sum_of(const std::vector<Reduced>& reduced, const std::vector<int>& windows, const Data& data, Role role);

/// Mean square (1: the floor) that the linearised windows promise after the step `d` of the chosen unknowns.
double promised_square(const Sum& sum, const std::vector<Eigen::Index>& chosen, const Eigen::VectorXd& d);

/// The step of the chosen unknowns that is best for the train windows and what is known beforehand.
Eigen::VectorXd solve_chosen(const Sum& train, const std::vector<Eigen::Index>& chosen, const Prior& known,
                             const Room& bounds);

}  // namespace plumbline::validation
