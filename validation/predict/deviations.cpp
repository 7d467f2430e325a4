#include "validation/predict/deviations.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "validation/predict/box_least_squares.h"

namespace plumbline::validation {

namespace {

bool is_constant(const Measured& channel) { return channel.values.minCoeff() == channel.values.maxCoeff(); }

/// Covariance of the scores' part that comes from readings that never change: one error of one floor for
/// each.
Eigen::MatrixXd constant_readings(const Data& data, const std::vector<int>& windows,
                                  const std::vector<Reduced>& reduced, Eigen::Index n) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t t = 0; t < data.trials.size(); ++t) {
    for (std::size_t c = 0; c < data.trials[t].measured.size(); ++c) {
      if (!is_constant(data.trials[t].measured[c])) {
        continue;
      }
      Eigen::VectorXd slope = Eigen::VectorXd::Zero(n);
      for (std::size_t i = 0; i < windows.size(); ++i) {
        const bool is_here = data.windows[static_cast<std::size_t>(windows[i])].trial == static_cast<int>(t);
        if (is_here) {
          slope += reduced[i].channel_slopes.col(static_cast<Eigen::Index>(c));
        }
      }
      covariance += slope * slope.transpose();
    }
  }
  return covariance;
}

/// H^-1, of unit diagonal first: how large a column is says nothing of how well it is told from the others.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& H) {
  const Eigen::VectorXd scale = H.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd unit = scale.asDiagonal() * H * scale.asDiagonal();
  const Eigen::MatrixXd inverse = unit.completeOrthogonalDecomposition().pseudoInverse();
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

}  // namespace

Eigen::VectorXd parameter_deviations(PredictorPool& pool, const std::vector<int>& windows,
                                     const std::vector<FreeParameter>& parameters, const Estimate& estimate,
                                     Eigen::MatrixXd* correlation) {
  const Data& data = pool.data();
  const Eigen::VectorXd units = search_units(parameters, estimate.theta);
  const std::vector<Reduced> reduced = reduce(pool, windows, parameters, estimate.theta, estimate.x0, units);
  const auto n = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n, n);
  for (const Reduced& one : reduced) {
    H += one.H;
    G += one.g * one.g.transpose();
  }
  // Never below what white residuals of the present size would give.
  double sse = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const auto w = static_cast<std::size_t>(windows[i]);
    sse += reduced[i].sse;
    const Trial& trial = data.trials[static_cast<std::size_t>(data.windows[w].trial)];
    count += static_cast<double>(data.windows[w].count) * static_cast<double>(trial.measured.size());
  }
  const Eigen::VectorXd known =
      prior(parameters, units, estimate.theta).H + Eigen::VectorXd::Constant(n, kPriorPrecision);
  H.diagonal() += known;
  const Eigen::MatrixXd inverse = inverse_of(H);
  const double m = static_cast<double>(windows.size());
  G *= m / std::max(1.0, m - static_cast<double>(n));
  G.diagonal() += known;
  G += constant_readings(data, windows, reduced, n);
  const Eigen::MatrixXd sandwich = inverse * G * inverse;
  const Eigen::MatrixXd white = inverse * (sse / std::max(1.0, count));
  Eigen::VectorXd deviations(n);
  for (Eigen::Index p = 0; p < n; ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const double search = std::sqrt(std::max({sandwich(p, p), white(p, p), 0.0})) * units[p];
    deviations[p] = std::abs(search_slope(parameter.scale, estimate.theta[p])) * search;
  }
  if (correlation != nullptr) {
    const Eigen::VectorXd scale = inverse.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    *correlation = scale.asDiagonal() * inverse * scale.asDiagonal();
  }
  return deviations;
}

}  // namespace plumbline::validation
