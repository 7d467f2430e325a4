#include "validation/identify/predict/cluster_scatter.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::validation {
namespace {

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

/// W with W H W' = 1 and W'W = H^-1, of unit diagonal first: how large a column is says nothing of how well
/// it is told from the others. What cannot be told at all has no row.
Eigen::MatrixXd whitening(const Eigen::MatrixXd& H) {
  constexpr double kRounding = 1e-14;
  const Eigen::VectorXd scale = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Solver solver(scale.asDiagonal() * H * scale.asDiagonal());
  const double least = kRounding * solver.eigenvalues().cwiseAbs().maxCoeff();
  Eigen::VectorXd root = Eigen::VectorXd::Zero(H.rows());
  for (Eigen::Index i = 0; i < root.size(); ++i) {
    root[i] = solver.eigenvalues()[i] > least ? 1.0 / std::sqrt(solver.eigenvalues()[i]) : 0.0;
  }
  return root.asDiagonal() * solver.eigenvectors().transpose() * scale.asDiagonal();
}

constexpr double kDecides = 1.0 / 16.0, kAlone = 1e-3;

/// (1 - S)^(-1/2). Where a window decides alone it has no residual, and what is left of one is how far the
/// search has gone: that is not made larger than four times, and not looked at where nothing else tells.
Eigen::MatrixXd unshrunk(const Eigen::MatrixXd& S) {
  const Solver solver(Eigen::MatrixXd::Identity(S.rows(), S.cols()) - S);
  const Eigen::VectorXd root = solver.eigenvalues().unaryExpr(
      [](double left) { return left < kAlone ? 0.0 : 1.0 / std::sqrt(std::max(left, kDecides)); });
  return solver.eigenvectors() * root.asDiagonal() * solver.eigenvectors().transpose();
}

/// Mean squared over variance, twice, of the quadratic form whose matrix is, over the windows v and w,
/// delta_vw b_w'd_w - d_v'd_w; b and d have a row for each window.
double freedom_of(const Eigen::MatrixXd& b, const Eigen::MatrixXd& d) {
  const Eigen::VectorXd own = (b.array() * d.array()).rowwise().sum();
  const Eigen::VectorXd shared = d.rowwise().squaredNorm();
  const double trace = own.sum() - shared.sum();
  const double square = own.squaredNorm() - 2.0 * own.dot(shared) + (d.transpose() * d).squaredNorm();
  return square > 0.0 ? trace * trace / square : 0.0;
}

}  // namespace

Scatter cluster_scatter(const std::vector<Reduced>& windows, const Eigen::MatrixXd& known,
                        const Eigen::MatrixXd& others) {
  const Eigen::Index n = known.rows();
  Eigen::MatrixXd H = known;
  for (const Reduced& window : windows) {
    H += window.H;
  }
  const Eigen::MatrixXd W = whitening(H);
  Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(n, n);
  std::vector<Eigen::MatrixXd> S, roots;
  for (const Reduced& window : windows) {
    S.emplace_back(W * window.H * W.transpose());
    roots.push_back(unshrunk(S.back()));
    const Eigen::VectorXd a = W.transpose() * (roots.back() * (W * window.g));
    seen += a * a.transpose();
  }
  const Eigen::MatrixXd assumed = others + known;
  Scatter scatter;
  scatter.inverse = W.transpose() * W;
  scatter.covariance = seen + W.transpose() * (W * assumed * W.transpose()) * W;
  scatter.freedom.resize(n);
  const auto m = static_cast<Eigen::Index>(windows.size());
  for (Eigen::Index p = 0; p < n; ++p) {
    Eigen::MatrixXd b(m, n);
    Eigen::MatrixXd d(m, n);
    for (Eigen::Index w = 0; w < m; ++w) {
      const auto i = static_cast<std::size_t>(w);
      b.row(w) = (roots[i] * W.col(p)).transpose();
      d.row(w) = (S[i] * b.row(w).transpose()).transpose();
    }
    // What is assumed has no scatter of its own.
    const double told = H(p, p) - known(p, p);
    const double unscattered = told > known(p, p) ? 0.0 : std::numeric_limits<double>::infinity();
    scatter.freedom[p] = seen(p, p) > 0.0
                             ? freedom_of(b, d) * std::pow(scatter.covariance(p, p) / seen(p, p), 2)
                             : unscattered;
  }
  return scatter;
}

}  // namespace plumbline::validation
