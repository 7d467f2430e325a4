#include "validation/identify/diagnose/odds.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/identify/predict/box_least_squares.h"

namespace plumbline::validation {
namespace {

/// Sum of the squared residuals of all windows as predicted, and how many there are.
struct Residuals {
  double square = 0.0;
  double count = 0.0;
  double mean() const { return square / std::max(1.0, count); }
};

Residuals residuals_of(const Estimate& estimate, const Data& data) {
  Residuals all;
  for (const int w : data.all_windows()) {
    all.square += estimate.predicted.square[static_cast<std::size_t>(w)].sum();
    all.count += readings(data, w);
  }
  return all;
}

/// s, in search units: `explained` is the fall of the sum of squares, `curvature` the value's entry in H.
double size_of(const FreeParameter& parameter, double unit, double explained, double curvature) {
  if (parameter.scale == effects::Scale::logarithm) {
    return 1.0 / unit;
  }
  const double range =
      std::abs(to_search(parameter.scale, parameter.upper) - to_search(parameter.scale, parameter.lower)) /
      unit;
  const double size = curvature > 0.0 ? std::sqrt(explained / curvature) : std::numeric_limits<double>::max();
  return std::isfinite(range) ? std::min(size, range) : size;
}

/// O of a refit.
double occam(const Refit& refit, double explained, double mean_square, const Data& data) {
  if (refit.own == 0) {
    return 0.0;  // no value was fitted
  }
  const std::vector<FreeParameter>& parameters = refit.extended.parameters;
  const Estimate& estimate = refit.estimate;
  const Eigen::VectorXd units = search_units(parameters, estimate.theta);
  const Eigen::Index n = units.size();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  PredictorPool pool(refit.extended.model, data);
  for (const Reduced& one :
       reduce(pool, data.all_windows(), parameters, estimate.theta, estimate.x0, units)) {
    H += one.H;
  }
  Eigen::MatrixXd known = prior(parameters, units, estimate.theta).H;
  known.diagonal().array() += kPriorPrecision;
  const Eigen::MatrixXd covariance =
      (H / std::max(1.0, mean_square) + known).ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  Eigen::VectorXd inverse(refit.own);
  for (Eigen::Index p = 0; p < inverse.size(); ++p) {
    const Eigen::Index at = n - inverse.size() + p;
    inverse[p] = 1.0 / size_of(parameters[static_cast<std::size_t>(at)], units[at], explained, H(at, at));
  }
  const Eigen::MatrixXd scaled = inverse.asDiagonal() *
                                 covariance.bottomRightCorner(inverse.size(), inverse.size()) *
                                 inverse.asDiagonal();
  const Eigen::ArrayXd l =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues().array().max(1e-300);
  return 0.5 * (l / (1.0 + l)).log().sum();
}

}  // namespace

double log_odds(const Stage& before, const Refit& one, const Refit& other, const Data& data) {
  const Residuals was = residuals_of(before.estimate, data);
  const Residuals of_one = residuals_of(one.estimate, data);
  const Residuals of_other = residuals_of(other.estimate, data);
  const double tempered = std::max(1.0, of_one.mean());
  const auto occam_of = [&](const Refit& refit, const Residuals& left) {
    return occam(refit, std::max(0.0, was.square - left.square), left.mean(), data);
  };
  return 0.5 * (of_other.square - of_one.square) / tempered + occam_of(one, of_one) -
         occam_of(other, of_other);
}

}  // namespace plumbline::validation
