#include "simulator/model/coordinate_map.h"

#include <algorithm>
#include <cmath>

#include "simulator/trace/error.h"

namespace plumbline::model {

CoordinateMap::CoordinateMap(const Model& model, const std::vector<effects::Values>& values,
                             const std::vector<Lock>& locks)
    : model_(model) {
  for (const Joint& joint : model_.skeleton.joints) {
    n_tree_ += joint.type == JointType::fixed ? 0 : 1;
  }
  n_ = n_tree_ + motors() + static_cast<int>(model_.pulleys.size());
  for (std::size_t e = 0; e < model_.effects.size(); ++e) {
    const EffectUse& use = model_.effects[e];
    if (model_.resolve(*use.law, use.at) == effects::Place::ratio && !use.law->is_null(values[e].data())) {
      released_.push_back(use.at);
    }
  }
  reduce(locks);
  find_stretch_map();
}

Eigen::VectorXd CoordinateMap::full_direction(const std::string& name) const {
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(n_);
  for (int m = 0; m < motors(); ++m) {
    if (model_.motors[static_cast<std::size_t>(m)].name == name) {
      direction[n_tree_ + m] = 1.0;
      return direction;
    }
  }
  if (const Pulley* pulley = model_.find_pulley(name)) {
    direction[n_tree_ + motors() + (pulley - model_.pulleys.data())] = 1.0;
    return direction;
  }
  if (const Coordinate* coordinate = model_.find_coordinate(name)) {
    for (const Term& term : coordinate->terms) {
      if (term.of == name) {
        break;  // a coordinate that names its own joint
      }
      direction += term.factor * full_direction(term.of);
    }
    if (!direction.isZero()) {
      return direction;
    }
  }
  int index = 0;
  for (const Joint& joint : model_.skeleton.joints) {
    if (joint.type == JointType::fixed) {
      continue;
    }
    if (joint.name == name) {
      direction[index] = 1.0;
      return direction;
    }
    ++index;
  }
  throw InputError(model_.file + ": no joint, coordinate, motor or pulley is named '" + name + "'");
}

// c(q) = q_from - sum ratio_i q_i (Park et al., equation 23).
Eigen::VectorXd CoordinateMap::stretch_direction(const Ratio& ratio) const {
  Eigen::VectorXd direction = full_direction(ratio.motor);
  for (const Term& term : ratio.to) {
    direction -= term.factor * full_direction(term.of);
  }
  return direction;
}

LinearForm CoordinateMap::line_of(const Eigen::VectorXd& full) const {
  LinearForm line{full, S_.transpose() * full, full.dot(q0_), {}};
  for (int i = 0; i < nz_; ++i) {
    if (line.reduced[i] != 0.0) {
      line.entries.push_back({i, line.reduced[i]});
    }
  }
  return line;
}

bool CoordinateMap::is_released(const std::string& name) const {
  return std::find(released_.begin(), released_.end(), name) != released_.end();
}

// Gauss elimination of the rigid ratios and locks. Each row gives up one coordinate: a ratio its motor, a
// lock the coordinate with the largest remaining coefficient.
void CoordinateMap::reduce(const std::vector<Lock>& locks) {
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> right;
  std::vector<std::string> names;
  std::vector<int> preferred;
  for (const Ratio& ratio : model_.ratios) {
    if (is_released(ratio.name)) {
      continue;
    }
    rows.push_back(stretch_direction(ratio));
    right.push_back(0.0);
    names.push_back("ratio " + ratio.name);
    Eigen::Index pivot = 0;
    full_direction(ratio.motor).cwiseAbs().maxCoeff(&pivot);
    preferred.push_back(static_cast<int>(pivot));
  }
  for (const Lock& lock : locks) {
    rows.push_back(full_direction(lock.at));
    right.push_back(lock.value);
    names.push_back("lock of " + lock.at);
    preferred.push_back(-1);
  }
  const auto r = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd A(r, n_);
  Eigen::VectorXd b(r);
  for (Eigen::Index i = 0; i < r; ++i) {
    A.row(i) = rows[static_cast<std::size_t>(i)].transpose();
    b[i] = right[static_cast<std::size_t>(i)];
  }
  std::vector<Eigen::Index> pivots;
  std::vector<bool> dependent(static_cast<std::size_t>(n_), false);
  for (Eigen::Index i = 0; i < r; ++i) {
    const double size = A.row(i).cwiseAbs().maxCoeff();
    Eigen::Index pivot = preferred[static_cast<std::size_t>(i)];
    if (pivot < 0 || dependent[static_cast<std::size_t>(pivot)] || std::abs(A(i, pivot)) < 1e-9) {
      A.row(i).cwiseAbs().maxCoeff(&pivot);
    }
    if (!(size > 1e-9) || std::abs(A(i, pivot)) < 1e-9) {
      throw InputError(
          model_.file + ": " + names[static_cast<std::size_t>(i)] +
          ": found a constraint that repeats or contradicts the others, expected an independent one");
    }
    b[i] /= A(i, pivot);
    A.row(i) /= A(i, pivot);
    for (Eigen::Index k = 0; k < r; ++k) {
      if (k != i && A(k, pivot) != 0.0) {
        b[k] -= A(k, pivot) * b[i];
        A.row(k) -= A(k, pivot) * A.row(i).eval();
      }
    }
    pivots.push_back(pivot);
    dependent[static_cast<std::size_t>(pivot)] = true;
  }
  nz_ = n_ - static_cast<int>(r);
  if (nz_ <= 0) {
    throw InputError(model_.file +
                     ": found no coordinate left to move, expected at least one that is neither "
                     "locked nor tied");
  }
  S_ = Eigen::MatrixXd::Zero(n_, nz_);
  q0_ = Eigen::VectorXd::Zero(n_);
  Eigen::Index column = 0;
  for (Eigen::Index j = 0; j < n_; ++j) {
    if (dependent[static_cast<std::size_t>(j)]) {
      continue;
    }
    S_(j, column) = 1.0;
    independent_.push_back(static_cast<int>(j));
    for (std::size_t i = 0; i < pivots.size(); ++i) {
      S_(pivots[i], column) = -A(static_cast<Eigen::Index>(i), j);
    }
    ++column;
  }
  for (std::size_t i = 0; i < pivots.size(); ++i) {
    q0_[pivots[i]] = b[static_cast<Eigen::Index>(i)];
  }
  S_tree_ = S_.topRows(n_tree_);
  rows_.resize(static_cast<std::size_t>(n_tree_));
  for (int i = 0; i < n_tree_; ++i) {
    for (int k = 0; k < nz_; ++k) {
      if (S_tree_(i, k) != 0.0) {
        rows_[static_cast<std::size_t>(i)].push_back({k, S_tree_(i, k)});
      }
    }
  }
}

void CoordinateMap::find_stretch_map() {
  Eigen::Index released = 0;
  stretch_map_.resize(static_cast<Eigen::Index>(model_.ratios.size()), nz_);
  for (const Ratio& ratio : model_.ratios) {
    if (is_released(ratio.name)) {
      stretch_map_.row(released++) = (S_.transpose() * stretch_direction(ratio)).transpose();
    }
  }
  stretch_map_.conservativeResize(released, nz_);
}

// Joints that move, motors, pulleys.
std::string CoordinateMap::name_of(int full) const {
  if (full >= n_tree_ + motors()) {
    return model_.pulleys[static_cast<std::size_t>(full - n_tree_ - motors())].name;
  }
  if (full >= n_tree_) {
    return model_.motors[static_cast<std::size_t>(full - n_tree_)].name;
  }
  int index = 0;
  for (const Joint& joint : model_.skeleton.joints) {
    if (joint.type != JointType::fixed && index++ == full) {
      return joint.name;
    }
  }
  return "";
}

}  // namespace plumbline::model
