// Fixed points of maps that are known only by evaluating them, and how small deviations grow there.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "validation/control/gait/shared_runs.h"

namespace plumbline::validation {

/// u -> P(u); nothing where the map is not defined (the robot fell). Called on several threads at once.
using Map = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)>;

/// dP/du by central differences, column by column, with `steps` (> 0); nothing when a point is not defined.
/// Each point of the map is one of the runners' runs.
std::optional<Eigen::MatrixXd> central_differences(const Map& map, const Eigen::VectorXd& at,
                                                   const Eigen::VectorXd& steps, const Runners& runners);

struct FixedPoint {
  bool found = false;
  Eigen::VectorXd at;
  double residual = 0.0;  ///< largest |P(u) - u| in steps
  Eigen::MatrixXd slope;  ///< dP/du there
  double growth = 0.0;    ///< largest |eigenvalue| of the slope
  int rounds = 0;         ///< of Newton's method
};

/// Newton's method from `guess`: u += (1 - dP/du)^+ (P(u) - u), the singular values below 1e-3 of the largest
/// left out and no coordinate moved by more than five steps a round, until |P(u) - u| is below `tolerance`
/// steps everywhere or `most` rounds have been made. Works for unstable fixed points too. `found`: the
/// tolerance was reached and the slope is known there.
FixedPoint find_fixed_point(const Map& map, const Eigen::VectorXd& guess, const Eigen::VectorXd& steps,
                            double tolerance, int most, const Runners& runners);

/// Largest |eigenvalue|.
double growth_of(const Eigen::MatrixXd& slope);

}  // namespace plumbline::validation
