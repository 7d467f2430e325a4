#include "simulator/model/loop_rows.h"

#include <algorithm>

#include "simulator/model/body_poses.h"

namespace plumbline::model {

using Eigen::Vector3d;

LoopRows::LoopRows(const Skeleton& skeleton, const std::vector<Loop>& loops, const Mechanism& mechanism)
    : on_world_(body_poses(skeleton, Eigen::VectorXd::Zero(mechanism.size()))) {
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const Loop& loop = loops[l];
    const auto index = static_cast<int>(l);
    length_ = std::max({length_, loop.ends[0].point.norm(), loop.ends[1].point.norm(), loop.length});
    if (loop.type == Loop::Type::rod) {
      Row rod;
      rod.loop = index;
      rod.at = {point_of(mechanism, loop.ends[0], Vector3d::Zero()),
                point_of(mechanism, loop.ends[1], Vector3d::Zero())};
      rod.length = loop.length;
      rows_.push_back(rod);
      continue;
    }
    add_point(mechanism, loop, index, Vector3d::Zero(), {0, 1, 2});
    if (loop.type == Loop::Type::hinge) {
      add_point(mechanism, loop, index, Vector3d::UnitZ(), {0, 1});
    } else if (loop.type == Loop::Type::weld) {
      add_point(mechanism, loop, index, Vector3d::UnitX(), {1, 2});
      add_point(mechanism, loop, index, Vector3d::UnitY(), {2});
    }
  }
  keep_.setIdentity(all(), all());
  length_ = std::max(length_, 1e-3);
}

LoopRows::Point LoopRows::point_of(const Mechanism& mechanism, const LoopEnd& end,
                                   const Vector3d& offset) const {
  Point point;
  point.point = end.point + end.axes * offset;
  if (end.body < 0) {
    return point;
  }
  point.body = mechanism.tree_body(end.body);
  if (point.body < 0) {  // fixed to the world
    point.point = on_world_[static_cast<std::size_t>(end.body)] * point.point;
  }
  return point;
}

void LoopRows::add_point(const Mechanism& mechanism, const Loop& loop, int index, const Vector3d& offset,
                         std::initializer_list<int> axes) {
  for (const int axis : axes) {
    Row row;
    row.loop = index;
    row.at = {point_of(mechanism, loop.ends[0], offset), point_of(mechanism, loop.ends[1], offset)};
    row.along = loop.ends[0].axes.col(axis);
    if (row.at[0].body < 0 && loop.ends[0].body >= 0) {
      row.along = on_world_[static_cast<std::size_t>(loop.ends[0].body)].linear() * row.along;
    }
    rows_.push_back(row);
  }
}

Vector3d LoopRows::station(const TreeDynamics& tree, const Point& at) {
  return at.body < 0 ? at.point : tree.station(at.body, at.point);
}

Vector3d LoopRows::turned(const TreeDynamics& tree, const Row& row) {
  return row.at[0].body < 0 ? row.along : Vector3d(tree.rotation(row.at[0].body) * row.along);
}

void LoopRows::errors(const TreeDynamics& tree, Eigen::VectorXd& errors) {
  all_.resize(all());
  for (int r = 0; r < all(); ++r) {
    const Row& row = rows_[static_cast<std::size_t>(r)];
    const Vector3d apart = station(tree, row.at[1]) - station(tree, row.at[0]);
    // (d - l) (d + l) / (2 l): of d^2 - l^2 half the digits would be lost.
    const double d = apart.norm();
    all_[r] = row.length > 0.0 ? (d - row.length) * (d + row.length) / (2.0 * row.length)
                               : apart.dot(turned(tree, row));
  }
  errors.noalias() = keep_ * all_;
}

void LoopRows::jacobian(const TreeDynamics& tree, int joints, Eigen::MatrixXd& J) {
  all_J_.resize(all(), joints);
  row_.resize(joints);
  for (int r = 0; r < all(); ++r) {
    const Row& row = rows_[static_cast<std::size_t>(r)];
    const Vector3d first = station(tree, row.at[0]);
    const Vector3d second = station(tree, row.at[1]);
    const bool rod = row.length > 0.0;
    const Vector3d along = rod ? Vector3d((second - first) / row.length) : turned(tree, row);
    row_.setZero();
    if (row.at[1].body >= 0) {
      tree.add_force(row.at[1].body, second, along, row_);
    }
    if (row.at[0].body >= 0) {
      tree.add_force(row.at[0].body, rod ? first : second, -along, row_);
    }
    all_J_.row(r) = row_.transpose();
  }
  J.noalias() = keep_ * all_J_;
}

void LoopRows::bias(const TreeDynamics& tree, Eigen::VectorXd& bias) {
  all_.resize(all());
  for (int r = 0; r < all(); ++r) {
    const Row& row = rows_[static_cast<std::size_t>(r)];
    const Vector3d first = station(tree, row.at[0]);
    const Vector3d second = station(tree, row.at[1]);
    const bool rod = row.length > 0.0;
    Vector3d velocity = Vector3d::Zero();  // of the second point, seen from the first body
    Vector3d acceleration = Vector3d::Zero();
    if (const int body = row.at[1].body; body >= 0) {
      velocity = tree.station_velocity(body, second);
      acceleration = tree.station_acceleration(body, second);
    }
    if (const int body = row.at[0].body; body >= 0) {
      const Vector3d& at = rod ? first : second;
      velocity -= tree.station_velocity(body, at);
      acceleration -= tree.station_acceleration(body, at);
      if (!rod) {
        acceleration -= 2.0 * tree.angular_velocity(body).cross(velocity);
      }
    }
    all_[r] = rod ? (velocity.squaredNorm() + (second - first).dot(acceleration)) / row.length
                  : acceleration.dot(turned(tree, row));
  }
  bias.noalias() = keep_ * all_;
}

}  // namespace plumbline::model
