#include "simulator/model/released_rods.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::model {

using Vector = Eigen::Map<const Eigen::VectorXd>;

int ReleasedRods::add(const std::string& name, const Mechanism& mechanism) {
  const auto known =
      std::find_if(rods_.begin(), rods_.end(), [&](const Rod& rod) { return rod.name == name; });
  if (known == rods_.end()) {
    const Loop& loop = *model_.find_rod(name);
    rods_.push_back({name, loop.length, LoopRows(model_.skeleton, {loop}, mechanism)});
    return static_cast<int>(rods_.size()) - 1;
  }
  return static_cast<int>(known - rods_.begin());
}

// The row of a rod that holds is phi = (d^2 - l^2) / (2 l): then s = d - l = 2 l phi / (d + l) and
// ds = l / d dphi.
double ReleasedRods::stretch(Rod& rod, const TreeDynamics& tree, Eigen::VectorXd& slope) {
  const double length = rod.length;
  rod.rows.errors(tree, error_);
  rod.rows.jacobian(tree, map_.tree(), row_);
  const double square = length * (length + 2.0 * error_[0]);
  const double apart = std::sqrt(std::max(square, std::numeric_limits<double>::min()));
  slope = length / apart * (row_ * map_.S_tree()).transpose();
  return 2.0 * length * error_[0] / (apart + length);
}

LinearForm ReleasedRods::line_at(int rod, const TreeDynamics& tree, const double* z) {
  LinearForm line;
  const double here = stretch(rods_[static_cast<std::size_t>(rod)], tree, line.reduced);
  line.offset = here;
  for (int i = 0; i < static_cast<int>(line.reduced.size()); ++i) {
    if (line.reduced[i] != 0.0) {
      line.entries.push_back({i, line.reduced[i]});
      line.offset -= line.reduced[i] * z[i];
    }
  }
  return line;
}

Eigen::MatrixXd ReleasedRods::curvature(int rod, const TreeDynamics& tree, const double* z) {
  constexpr double kStep = 1e-6;  // rad or m
  const int n = map_.independent();
  TreeDynamics moved = tree;
  Eigen::VectorXd at = Vector(z, n);
  Eigen::VectorXd up, down;
  Eigen::MatrixXd curvature(n, n);
  const auto slope_at = [&](Eigen::VectorXd& slope) {
    moved.place(map_.S_tree() * at + map_.q0().head(map_.tree()));
    stretch(rods_[static_cast<std::size_t>(rod)], moved, slope);
  };
  for (int k = 0; k < n; ++k) {
    at[k] = z[k] + kStep;
    slope_at(up);
    at[k] = z[k] - kStep;
    slope_at(down);
    at[k] = z[k];
    curvature.col(k) = (up - down) / (2.0 * kStep);
  }
  return curvature;
}

}  // namespace plumbline::model
