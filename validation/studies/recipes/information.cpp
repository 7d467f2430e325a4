#include "validation/studies/recipes/information.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::validation {
namespace {

constexpr double kSmallPart = 0.1;  // of a unit vector; not worth a word

}  // namespace

std::vector<WeakDirection> weak_directions(const Eigen::MatrixXd& H, const std::vector<std::string>& names,
                                           double most) {
  std::vector<WeakDirection> weak;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(H);  // ascending
  for (Eigen::Index i = 0; i < H.rows(); ++i) {
    const double value = solver.eigenvalues()[i];
    WeakDirection direction;
    direction.deviation = value > 0.0 ? 1.0 / std::sqrt(value) : std::numeric_limits<double>::infinity();
    if (direction.deviation <= most) {
      break;
    }
    for (Eigen::Index p = 0; p < H.rows(); ++p) {
      const double part = solver.eigenvectors()(p, i);
      if (std::abs(part) > kSmallPart) {
        direction.parts.emplace_back(names[static_cast<std::size_t>(p)], part);
      }
    }
    std::sort(direction.parts.begin(), direction.parts.end(),
              [](const auto& a, const auto& b) { return std::abs(a.second) > std::abs(b.second); });
    weak.push_back(std::move(direction));
  }
  return weak;
}

std::vector<StrongCorrelation> strong_correlations(const Eigen::MatrixXd& H,
                                                   const std::vector<std::string>& names, double least) {
  const Eigen::MatrixXd inverse = H.completeOrthogonalDecomposition().pseudoInverse();
  std::vector<StrongCorrelation> strong;
  for (Eigen::Index i = 0; i < H.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double both = std::sqrt(inverse(i, i) * inverse(j, j));
      const double correlation = both > 0.0 ? inverse(i, j) / both : 0.0;
      if (std::abs(correlation) > least) {
        strong.push_back(
            {names[static_cast<std::size_t>(j)], names[static_cast<std::size_t>(i)], correlation});
      }
    }
  }
  std::sort(strong.begin(), strong.end(),
            [](const auto& a, const auto& b) { return std::abs(a.value) > std::abs(b.value); });
  return strong;
}

}  // namespace plumbline::validation
