#include "validation/identify/standard/bounded_minimum.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace plumbline::validation {
namespace {

std::vector<Eigen::Index> free_indices(const std::vector<bool>& held) {
  std::vector<Eigen::Index> indices;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (!held[i]) {
      indices.push_back(static_cast<Eigen::Index>(i));
    }
  }
  return indices;
}

/// Moves along `step` as far as the bounds allow, and holds what meets one. True: all the way.
bool move(const Eigen::VectorXd& step, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
          BoundedMinimum& d) {
  double share = 1.0;
  Eigen::Index meets = -1;
  for (Eigen::Index i = 0; i < step.size(); ++i) {
    const double bound = step[i] > 0.0 ? upper[i] : lower[i];
    const double room = step[i] == 0.0 ? 1.0 : (bound - d.at[i]) / step[i];
    if (room < share) {
      share = std::max(room, 0.0);
      meets = i;
    }
  }
  d.at += share * step;
  if (meets < 0) {
    return true;
  }
  d.at[meets] = step[meets] > 0.0 ? upper[meets] : lower[meets];
  d.held[static_cast<std::size_t>(meets)] = true;
  return false;
}

/// Lets go the one held value that most wants to leave its bound; false when none does.
bool release(const Eigen::MatrixXd& H, const Eigen::VectorXd& slope, const Eigen::VectorXd& lower,
             const Eigen::VectorXd& upper, BoundedMinimum& d) {
  constexpr double kLeast = 1e-9;  // of a step in standard deviations
  double most = kLeast;
  std::size_t which = d.held.size();
  for (std::size_t i = 0; i < d.held.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double inwards = d.at[k] == lower[k] ? slope[k] : -slope[k];
    const double gain = inwards / std::sqrt(H(k, k));
    if (d.held[i] && lower[k] < upper[k] && gain > most) {
      most = gain;
      which = i;
    }
  }
  if (which == d.held.size()) {
    return false;
  }
  d.held[which] = false;
  return true;
}

}  // namespace

Eigen::MatrixXd free_part(const Eigen::MatrixXd& H, const std::vector<bool>& held) {
  const std::vector<Eigen::Index> indices = free_indices(held);
  return H(indices, indices);
}

Eigen::VectorXd free_part(const Eigen::VectorXd& g, const std::vector<bool>& held) {
  return g(free_indices(held));
}

BoundedMinimum bounded_minimum(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                               const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  BoundedMinimum d{Eigen::VectorXd::Zero(g.size()), std::vector<bool>(static_cast<std::size_t>(g.size()))};
  const Eigen::Index most = 50 + 20 * g.size();
  for (Eigen::Index pass = 0; pass < most; ++pass) {
    const std::vector<Eigen::Index> loose = free_indices(d.held);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(g.size());
    const Eigen::VectorXd slope = g - H * d.at;
    if (!loose.empty()) {
      const Eigen::VectorXd some =
          Eigen::MatrixXd(H(loose, loose)).ldlt().solve(Eigen::VectorXd(slope(loose)));
      step(loose) = some;
    }
    if (move(step, lower, upper, d) && !release(H, g - H * d.at, lower, upper, d)) {
      break;
    }
  }
  return d;
}

}  // namespace plumbline::validation
