#include "validation/identify/diagnose/contradicted.h"

#include <cmath>

#include "validation/identify/predict/deviations.h"

namespace plumbline::validation {
namespace {

/// The parameters of one effect and their fitted values.
struct OwnPart {
  std::vector<FreeParameter> parameters;
  Eigen::VectorXd theta;
};

OwnPart part_of(const Stage& stage, int effect) {
  OwnPart part;
  std::vector<double> values;
  for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
    if (stage.parameters[p].id.effect == effect) {
      part.parameters.push_back(stage.parameters[p]);
      values.push_back(stage.estimate.predicted.theta[static_cast<Eigen::Index>(p)]);
    }
  }
  part.theta = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return part;
}

}  // namespace

double asked_otherwise(const Stage& stage, int effect, const Data& data) {
  const std::vector<int> windows = data.windows_of(Role::held_out);
  const OwnPart own = part_of(stage, effect);
  const Eigen::Index n = own.theta.size();
  if (windows.empty() || n == 0) {
    return 0.0;
  }
  PredictorPool pool(with_values(stage.model, stage.parameters, stage.estimate.predicted.theta), data);
  const Eigen::VectorXd units = search_units(own.parameters, own.theta);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
  for (const Reduced& one : reduce(pool, windows, own.parameters, own.theta, stage.estimate.x0, units)) {
    H += one.H;
    g += one.g;
  }
  Eigen::VectorXd direction(n);
  for (Eigen::Index p = 0; p < n; ++p) {
    direction[p] = to_search(own.parameters[static_cast<std::size_t>(p)].scale, own.theta[p]) / units[p];
  }
  const double curvature = direction.dot(H * direction);
  return curvature > 0.0 ? std::abs(direction.dot(g)) / curvature : 0.0;
}

}  // namespace plumbline::validation
