#include "simulator/model/correlations.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace plumbline::model {
namespace {

/// -1: not listed.
Eigen::Index index_of(const std::vector<std::string>& labels, const std::string& label) {
  const auto found = std::find(labels.begin(), labels.end(), label);
  return found == labels.end() ? -1 : found - labels.begin();
}

}  // namespace

Eigen::MatrixXd Correlations::among(const std::vector<std::string>& labels) const {
  const auto count = static_cast<Eigen::Index>(labels.size());
  std::vector<Eigen::Index> index;
  index.reserve(labels.size());
  for (const std::string& label : labels) {
    index.push_back(index_of(of, label));
  }
  Eigen::MatrixXd some = Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const Eigen::Index a = index[static_cast<std::size_t>(i)];
      const Eigen::Index b = index[static_cast<std::size_t>(j)];
      some(i, j) = some(j, i) = a >= 0 && b >= 0 && a != b ? matrix(a, b) : 0.0;
    }
  }
  return some;
}

Correlations Correlations::without(const std::vector<std::string>& labels) const {
  Correlations rest;
  std::copy_if(of.begin(), of.end(), std::back_inserter(rest.of),
               [&](const std::string& label) { return index_of(labels, label) < 0; });
  rest.matrix = among(rest.of);
  return rest;
}

Correlations joined(const Correlations& a, const Correlations& b) {
  Correlations both{a.of, {}};
  both.of.insert(both.of.end(), b.of.begin(), b.of.end());
  const auto count = static_cast<Eigen::Index>(both.of.size());
  both.matrix = Eigen::MatrixXd::Identity(count, count);
  both.matrix.topLeftCorner(a.matrix.rows(), a.matrix.cols()) = a.matrix;
  both.matrix.bottomRightCorner(b.matrix.rows(), b.matrix.cols()) = b.matrix;
  return both;
}

Eigen::MatrixXd writable_correlation(const Eigen::MatrixXd& matrix) {
  constexpr double kShrunk = 1e-4;
  Eigen::MatrixXd written = matrix.unaryExpr(
      [](double r) { return std::isfinite(r) ? std::clamp(r, -1.0, 1.0) / (1.0 + kShrunk) : 0.0; });
  written.diagonal().setOnes();
  return written;
}

}  // namespace plumbline::model
