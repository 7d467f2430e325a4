// Where the feet went in a recorded motion, as its sensors say.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// m, depth of a foot that carries a robot on a hard ground.
constexpr double kDepthAtRest = 5e-4;

/// One foot over one trial.
struct FootPath {
  std::size_t foot = 0;    ///< index in the model
  double period = 0.0;     ///< s, of the samples that were looked at
  Eigen::MatrixXd places;  ///< m, three coordinates and the depth, 4 x samples
};

/// One path for each trial and foot that has a ground, from positions that fit the measured channels best.
/// Looks at samples about `spacing` s apart, 0: at all, and at the first `most` of each trial.
std::vector<FootPath> foot_paths(const model::Model& model, const Data& data, double spacing = 0.0,
                                 Eigen::Index most = std::numeric_limits<Eigen::Index>::max());

/// The depth that all but the deepest twentieth of the samples stay above.
double depth_reached(std::vector<double> depths);

}  // namespace plumbline::validation
