#include "validation/predict/standing_feet.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace plumbline::validation {
namespace {

constexpr double kSpacing = 0.005;          // s, of the samples that are looked at
constexpr std::size_t kMostSamples = 4000;  // of all trials: a minute of a long log tells enough
constexpr Eigen::Index kHalfSpan = 2;       // samples to either side for a speed: counts are coarse

/// The places of one foot over a trial, three coordinates and the depth, 4 x samples.
struct Path {
  double period = kSpacing;
  Eigen::MatrixXd places;
};

/// Consecutive samples of one path in which its foot stands.
struct Standing {
  std::size_t path = 0;
  Eigen::Index first = 0, count = 0;
};

/// One path for each trial and foot that has a ground.
std::vector<Path> paths_of(const model::Model& model, const Data& data) {
  std::vector<Path> paths;
  const std::size_t most = kMostSamples / std::max<std::size_t>(data.trials.size(), 1);
  for (const Trial& trial : data.trials) {
    Predictor predictor(model, trial, data.predict);
    model::Plant& plant = predictor.plant();
    if (!plant.meets_ground()) {
      continue;
    }
    const Eigen::MatrixXd positions = predictor.measured_positions();
    const auto stride = std::max<Eigen::Index>(1, std::lround(kSpacing / trial.period));
    const Eigen::Index count =
        std::min<Eigen::Index>((positions.cols() - 1) / stride + 1, static_cast<Eigen::Index>(most));
    const std::size_t first = paths.size();
    for (std::size_t f = 0; f < model.feet.size(); ++f) {
      paths.push_back({static_cast<double>(stride) * trial.period, Eigen::MatrixXd(4, count)});
    }
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    for (Eigen::Index k = 0; k < count; ++k) {
      x.head(positions.rows()) = positions.col(k * stride);
      const std::vector<model::Touch> touches = plant.touches(x.data());
      for (std::size_t f = 0; f < touches.size(); ++f) {
        paths[first + f].places.col(k) << touches[f].position,
            plant.foot_depth(static_cast<int>(f), x.data()).depth;
      }
    }
  }
  return paths;
}

/// The depth that all but the deepest twentieth of the samples stay above.
double reached(const Path& path) {
  constexpr double kDeepest = 0.05;
  std::vector<double> depths;
  for (Eigen::Index k = 0; k < path.places.cols(); ++k) {
    depths.push_back(path.places(3, k));
  }
  const auto at =
      depths.begin() + static_cast<std::ptrdiff_t>((1.0 - kDeepest) * static_cast<double>(depths.size() - 1));
  std::nth_element(depths.begin(), at, depths.end());
  return *at;
}

/// Does the foot stay within `most` m along the ground from sample `first` to `last`?
bool stays(const Path& path, Eigen::Index first, Eigen::Index last, double most) {
  const auto along = path.places.topRows<2>().middleCols(first, last + 1 - first);
  return (along.rowwise().maxCoeff() - along.rowwise().minCoeff()).maxCoeff() < most;
}

std::vector<Standing> stances_of(const std::vector<Path>& paths) {
  constexpr double kNear = 0.03;        // m: what zero errors of a few degrees do to a leg of a metre
  constexpr double kSlow = 0.5;         // m/s: a leg swings by less, a foot that lands is faster
  constexpr double kStays = 0.02;       // m
  constexpr double kShortest = 0.08;    // s, without
  constexpr Eigen::Index kTrimmed = 2;  // samples at either end: landing and lift-off
  std::vector<Standing> stances;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Path& path = paths[i];
    const Eigen::Index last = path.places.cols() - kHalfSpan;
    if (last <= kHalfSpan || !path.places.allFinite()) {
      continue;
    }
    const double near = reached(path) - kNear;
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
Eigen::VectorXd residuals(const std::vector<Path>& paths, const std::vector<Standing>& stances) {
  constexpr double kRest = 5e-4, kWell = 2e-3;  // m
  constexpr double kIndependent = 0.02;         // s
  Eigen::Index rows = 0;
  for (const Standing& stance : stances) {
    rows += 3 * stance.count;
  }
  Eigen::VectorXd r(rows);
  Eigen::Index next = 0;
  for (const Standing& stance : stances) {
    const Path& path = paths[stance.path];
    const auto places = path.places.middleCols(stance.first, stance.count);
    const Eigen::Vector2d mean = places.topRows<2>().rowwise().mean();
    const double weight = std::sqrt(std::min(1.0, path.period / kIndependent)) / kWell;
    for (Eigen::Index k = 0; k < stance.count; ++k) {
      r.segment<3>(next) << weight * (places.col(k).head<2>() - mean), weight * (places(3, k) - kRest);
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
  const auto paths_at = [&](const Eigen::VectorXd& scaled) {
    return paths_of(with_offsets(scaled.cwiseProduct(deviations)), data);
  };
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<Path> paths = paths_at(here);
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
