#include "validation/identify/predict/deviations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/identify/predict/box_least_squares.h"
#include "validation/identify/predict/cluster_scatter.h"

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

/// Mean square of the windows' residuals, floor units.
double mean_square(const Data& data, const std::vector<int>& windows, const std::vector<Reduced>& reduced) {
  double sse = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    sse += reduced[i].sse;
    count += readings(data, windows[i]);
  }
  return sse / std::max(1.0, count);
}

/// Variances of the parameters where the model is far off: what the windows say counts by as much less as
/// they contradict each other more than their floors, f = tr(H C) / n with their normal equations H and the
/// scatter's covariance C; what is known of the parameters keeps its weight. Without it a parameter that the
/// windows hardly tell would seem to be open far beyond what is stated of it, because each of them pulls at
/// it with all that the model lacks.
Eigen::VectorXd tempered_variances(const std::vector<Reduced>& reduced, const Eigen::MatrixXd& known,
                                   const Scatter& scatter) {
  const Eigen::Index n = known.rows();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  for (const Reduced& one : reduced) {
    H += one.H;
  }
  const double f =
      std::max(1.0, (H * scatter.covariance).trace() / static_cast<double>(std::max<Eigen::Index>(n, 1)));
  H /= f;
  H += known;
  return H.ldlt().solve(Eigen::MatrixXd::Identity(n, n)).diagonal();
}

}  // namespace

Precision precision_of(PredictorPool& pool, const std::vector<int>& windows,
                       const std::vector<FreeParameter>& parameters, const Estimate& estimate) {
  const Data& data = pool.data();
  const Eigen::VectorXd units = search_units(parameters, estimate.theta);
  const std::vector<Reduced> reduced = reduce(pool, windows, parameters, estimate.theta, estimate.x0, units);
  const auto n = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd known = prior(parameters, units, estimate.theta).H;
  known.diagonal().array() += kPriorPrecision;
  const Scatter scatter = cluster_scatter(reduced, known, constant_readings(data, windows, reduced, n));
  const double white = mean_square(data, windows, reduced);
  constexpr double kFar = 9.0;  // mean square, from which more is missing than noise
  const Eigen::VectorXd most = white > kFar
                                   ? tempered_variances(reduced, known, scatter)
                                   : Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  Precision precision{Eigen::VectorXd(n), Eigen::VectorXd(n), {}, scatter.freedom, {}, scatter.inverse};
  for (Eigen::Index p = 0; p < n; ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const double least = white * scatter.inverse(p, p);
    const double variance = std::min(std::max(scatter.covariance(p, p), least), most[p]);
    const double search = std::sqrt(variance) * units[p];
    precision.deviations[p] = std::abs(search_slope(parameter.scale, estimate.theta[p])) * search;
    precision.below[p] = search;
  }
  precision.above = precision.below;
  const Eigen::VectorXd scale = scatter.inverse.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  precision.correlation = scale.asDiagonal() * scatter.inverse * scale.asDiagonal();
  return precision;
}

model::Correlations correlations_of(const std::vector<FreeParameter>& parameters,
                                    const Eigen::VectorXd& theta, const Precision& precision) {
  const Eigen::MatrixXd& correlation = precision.correlation;
  model::Correlations together;
  if (correlation.rows() != static_cast<Eigen::Index>(parameters.size())) {
    return together;
  }
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto p = static_cast<Eigen::Index>(i);
    const auto alike = std::count_if(parameters.begin(), parameters.end(), [&](const FreeParameter& other) {
      return other.label == parameters[i].label;
    });
    if (alike == 1 && correlation(p, p) > 0.5) {
      together.of.push_back(parameters[i].label);
      kept.push_back(p);
    }
  }
  // What is searched along its reciprocal falls where the search rises.
  Eigen::VectorXd sign(theta.size());
  for (Eigen::Index p = 0; p < theta.size(); ++p) {
    sign[p] = search_slope(parameters[static_cast<std::size_t>(p)].scale, theta[p]) < 0.0 ? -1.0 : 1.0;
  }
  const Eigen::MatrixXd signed_correlation = sign.asDiagonal() * correlation * sign.asDiagonal();
  together.matrix = signed_correlation(kept, kept);
  return together;
}

}  // namespace plumbline::validation
