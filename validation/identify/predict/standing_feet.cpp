#include "validation/identify/predict/standing_feet.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "validation/identify/predict/foot_paths.h"

namespace plumbline::validation {
namespace {

constexpr double kSpacing = 0.005;           // s, of the samples that are looked at
constexpr Eigen::Index kMostSamples = 4000;  // of all trials: a minute of a long log tells enough
constexpr Eigen::Index kHalfSpan = 2;        // samples to either side for a speed: counts are coarse

/// Consecutive samples of one path in which its foot stands.
struct Standing {
  std::size_t path = 0;
  Eigen::Index first = 0, count = 0;
};

/// Does the foot stay within `most` m along the ground from sample `first` to `last`?
bool stays(const FootPath& path, Eigen::Index first, Eigen::Index last, double most) {
  const auto along = path.places.topRows<2>().middleCols(first, last + 1 - first);
  return (along.rowwise().maxCoeff() - along.rowwise().minCoeff()).maxCoeff() < most;
}

std::vector<Standing> stances_of(const std::vector<FootPath>& paths) {
  constexpr double kNear = 0.03;        // m: what zero errors of a few degrees do to a leg of a metre
  constexpr double kSlow = 0.5;         // m/s: a leg swings by less, a foot that lands is faster
  constexpr double kStays = 0.02;       // m
  constexpr double kShortest = 0.08;    // s, without the trimmed ones
  constexpr Eigen::Index kTrimmed = 2;  // samples at either end: landing and lift-off
  std::vector<Standing> stances;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const FootPath& path = paths[i];
    const Eigen::Index last = path.places.cols() - kHalfSpan;
    if (last <= kHalfSpan || !path.places.allFinite()) {
      continue;
    }
    const Eigen::VectorXd depths = path.places.row(3);
    const double near = depth_reached({depths.begin(), depths.end()}) - kNear;
    const double far = 2.0 * static_cast<double>(kHalfSpan) * path.period * kSlow;
    Eigen::Index since = kHalfSpan;
    for (Eigen::Index k = kHalfSpan; k <= last; ++k) {
      const bool is_slow = k < last && path.places(3, k) > near &&
                           (path.places.col(k + kHalfSpan) - path.places.col(k - kHalfSpan)).norm() < far;
      if (is_slow && stays(path, since, k, kStays)) {
        continue;
      }
      const Eigen::Index count = k - since - 2 * kTrimmed;
      if (static_cast<double>(count) * path.period >= kShortest) {
        stances.push_back({i, since + kTrimmed, count});
      }
      since = is_slow ? k : k + 1;
    }
  }
  return stances;
}

/// Depth, and place along the ground less its mean over the stance, in units of s; all stances in a row.
Eigen::VectorXd residuals(const std::vector<FootPath>& paths, const std::vector<Standing>& stances) {
  constexpr double kWell = 2e-3;         // m
  constexpr double kIndependent = 0.02;  // s
  Eigen::Index rows = 0;
  for (const Standing& stance : stances) {
    rows += 3 * stance.count;
  }
  Eigen::VectorXd r(rows);
  Eigen::Index next = 0;
  for (const Standing& stance : stances) {
    const FootPath& path = paths[stance.path];
    const auto places = path.places.middleCols(stance.first, stance.count);
    const Eigen::Vector2d mean = places.topRows<2>().rowwise().mean();
    const double weight = std::sqrt(std::min(1.0, path.period / kIndependent)) / kWell;
    for (Eigen::Index k = 0; k < stance.count; ++k) {
      r.segment<3>(next) << weight * (places.col(k).head<2>() - mean), weight * (places(3, k) - kDepthAtRest);
      next += 3;
    }
  }
  return r;
}

}  // namespace

Eigen::VectorXd offsets_of_standing_feet(
    const Data& data, const std::function<model::Model(const Eigen::VectorXd&)>& with_offsets,
    const Eigen::VectorXd& deviations, const Eigen::VectorXd& start) {
  constexpr int kSteps = 5;
  constexpr double kDifference = 0.02;  // of a deviation
  const Eigen::Index count = deviations.size();
  Eigen::VectorXd here = start.cwiseQuotient(deviations);
  const Eigen::Index most =
      kMostSamples / std::max<Eigen::Index>(static_cast<Eigen::Index>(data.trials.size()), 1);
  const auto paths_at = [&](const Eigen::VectorXd& scaled) {
    return foot_paths(with_offsets(scaled.cwiseProduct(deviations)), data, kSpacing, most);
  };
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<FootPath> paths = paths_at(here);
    const std::vector<Standing> stances = stances_of(paths);
    if (stances.empty()) {
      return start;
    }
    const Eigen::VectorXd r = residuals(paths, stances);
    Eigen::MatrixXd J(r.size(), count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::VectorXd there = here + kDifference * Eigen::VectorXd::Unit(count, i);
      J.col(i) = (residuals(paths_at(there), stances) - r) / kDifference;
    }
    const Eigen::MatrixXd H = J.transpose() * J + Eigen::MatrixXd::Identity(count, count);
    here -= H.ldlt().solve(J.transpose() * r + here);
  }
  return here.cwiseProduct(deviations);
}

}  // namespace plumbline::validation
