#include "validation/hopping/fixed_point.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <vector>

#include "validation/predict/problem.h"

namespace plumbline::validation {
namespace {

constexpr double kSingular = 1e-3;
constexpr double kFurthest = 5.0;  // steps in a round: beyond, the slope says little

}  // namespace

std::optional<Eigen::MatrixXd> central_differences(const Map& map, const Eigen::VectorXd& at,
                                                   const Eigen::VectorXd& steps, int threads) {
  const Eigen::Index n = at.size();
  std::vector<std::optional<Eigen::VectorXd>> ends(static_cast<std::size_t>(2 * n));
  parallel_for(static_cast<int>(2 * n), threads, [&](int i) {
    Eigen::VectorXd moved = at;
    moved[i / 2] += i % 2 == 0 ? steps[i / 2] : -steps[i / 2];
    ends[static_cast<std::size_t>(i)] = map(moved);
  });
  Eigen::MatrixXd slope(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto& up = ends[static_cast<std::size_t>(2 * j)];
    const auto& down = ends[static_cast<std::size_t>(2 * j + 1)];
    if (!up || !down) {
      return std::nullopt;
    }
    slope.col(j) = (*up - *down) / (2.0 * steps[j]);
  }
  return slope;
}

double growth_of(const Eigen::MatrixXd& slope) { return slope.eigenvalues().cwiseAbs().maxCoeff(); }

FixedPoint find_fixed_point(const Map& map, const Eigen::VectorXd& guess, const Eigen::VectorXd& steps,
                            double tolerance, int most, int threads) {
  FixedPoint point;
  point.at = guess;
  const Eigen::Index n = guess.size();
  for (;; ++point.rounds) {
    const auto image = map(point.at);
    if (!image) {
      return point;
    }
    const Eigen::VectorXd off = (*image - point.at).cwiseQuotient(steps);
    point.residual = off.cwiseAbs().maxCoeff();
    const auto slope = central_differences(map, point.at, steps, threads);
    if (!slope) {
      return point;
    }
    point.slope = *slope;
    point.growth = growth_of(*slope);
    point.found = point.residual <= tolerance;
    if (point.found || point.rounds >= most) {
      return point;
    }
    const Eigen::MatrixXd scaled =
        Eigen::MatrixXd::Identity(n, n) - steps.cwiseInverse().asDiagonal() * (*slope) * steps.asDiagonal();
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(kSingular);
    const Eigen::VectorXd step = svd.solve(off);
    point.at += steps.cwiseProduct(step * std::min(1.0, kFurthest / step.cwiseAbs().maxCoeff()));
  }
}

}  // namespace plumbline::validation
