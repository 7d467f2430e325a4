#include "validation/control/gait/fixed_point.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <vector>

namespace plumbline::validation {
namespace {

constexpr double kSingular = 1e-3;
constexpr double kFurthest = 5.0;  // steps in a round: beyond, the slope says little

std::string bytes_of(const std::optional<Eigen::VectorXd>& image) {
  work::Bytes bytes;
  if (image) {
    bytes.add(image->data(), static_cast<std::size_t>(image->size()));
  }
  return bytes.all();
}

/// No bytes: no image.
std::optional<Eigen::VectorXd> image_from(work::BytesReader& reader) {
  if (reader.at_end()) {
    return std::nullopt;
  }
  const std::vector<double> numbers = reader.numbers();
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

}  // namespace

std::optional<Eigen::MatrixXd> central_differences(const Map& map, const Eigen::VectorXd& at,
                                                   const Eigen::VectorXd& steps, const Runners& runners) {
  const Eigen::Index n = at.size();
  std::vector<std::optional<Eigen::VectorXd>> ends(static_cast<std::size_t>(2 * n));
  SharedRuns points{"point of the return map", static_cast<int>(2 * n), {}, {}, {}};
  points.work = [&](int i) {
    Eigen::VectorXd moved = at;
    moved[i / 2] += i % 2 == 0 ? steps[i / 2] : -steps[i / 2];
    ends[static_cast<std::size_t>(i)] = map(moved);
  };
  points.result = [&](int i) { return bytes_of(ends[static_cast<std::size_t>(i)]); };
  points.take = [&](int i, work::BytesReader& reader) {
    ends[static_cast<std::size_t>(i)] = image_from(reader);
  };
  share_runs(points, runners);
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
                            double tolerance, int most, const Runners& runners) {
  FixedPoint best;
  best.at = guess;
  Eigen::VectorXd at = guess;
  const Eigen::Index n = guess.size();
  for (int round = 0; round <= most; ++round) {
    const auto image = map(at);
    const auto slope = image ? central_differences(map, at, steps, runners) : std::nullopt;
    if (!slope) {
      return best;
    }
    const Eigen::VectorXd off = (*image - at).cwiseQuotient(steps);
    const double residual = off.cwiseAbs().maxCoeff();
    if (round == 0 || residual < best.residual) {
      best = {residual <= tolerance, at, residual, *slope, growth_of(*slope), round};
    }
    if (best.found) {
      return best;
    }
    const Eigen::MatrixXd scaled =
        Eigen::MatrixXd::Identity(n, n) - steps.cwiseInverse().asDiagonal() * (*slope) * steps.asDiagonal();
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(kSingular);
    const Eigen::VectorXd step = svd.solve(off);
    at += steps.cwiseProduct(step * std::min(1.0, kFurthest / step.cwiseAbs().maxCoeff()));
  }
  return best;
}

}  // namespace plumbline::validation
