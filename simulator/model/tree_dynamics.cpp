#include "simulator/model/tree_dynamics.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::model {

TreeDynamics::TreeDynamics(std::vector<TreeBody> bodies, int coordinates, const Eigen::Vector3d& gravity)
    : bodies_(std::move(bodies)), size_(coordinates), gravity_(gravity) {
  const std::size_t n = bodies_.size();
  R_.assign(n, Eigen::Matrix3d::Identity());
  p_.assign(n, Eigen::Vector3d::Zero());
  axis_.assign(n, Vector6::Zero());
  velocity_ = acceleration_ = force_ = axis_;
  composite_.resize(n);
  for (const TreeBody& body : bodies_) {
    turns_.push_back(turn_of(body));
  }
}

TreeDynamics::Turn TreeDynamics::turn_of(const TreeBody& body) {
  Turn turn;
  turn.at_zero = body.X_PB.linear();
  turn.sine.setZero();
  turn.versine.setZero();
  turn.slide.setZero();
  turn.origin = body.X_PB * body.hinge;
  if (body.coordinate >= 0 && body.slides) {
    turn.slide = turn.at_zero * body.axis;
  } else if (body.coordinate >= 0) {
    Eigen::Matrix3d across;
    across << 0.0, -body.axis.z(), body.axis.y(), body.axis.z(), 0.0, -body.axis.x(), -body.axis.y(),
        body.axis.x(), 0.0;
    turn.sine = turn.at_zero * across;
    turn.versine = turn.sine * across;
  }
  return turn;
}

void TreeDynamics::place(const Eigen::VectorXd& q) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    pose(b, q);
    weigh(b);
  }
}

void TreeDynamics::pose(std::size_t b, const Eigen::VectorXd& q) {
  const TreeBody& it = bodies_[b];
  const Turn& turn = turns_[b];
  Eigen::Matrix3d R_PB = turn.at_zero;
  Eigen::Vector3d p_PB = turn.origin;
  if (it.coordinate >= 0 && it.arc.is_bent()) {
    const Eigen::Isometry3d way = slid(it.axis, it.arc, q[it.coordinate]);
    R_PB = turn.at_zero * way.linear();
    p_PB += turn.at_zero * way.translation();
  } else if (it.coordinate >= 0 && it.slides) {
    p_PB += q[it.coordinate] * turn.slide;
  } else if (it.coordinate >= 0) {
    R_PB += std::sin(q[it.coordinate]) * turn.sine + (1.0 - std::cos(q[it.coordinate])) * turn.versine;
  }
  p_PB.noalias() -= R_PB * it.hinge;
  if (it.parent < 0) {
    R_[b] = R_PB;
    p_[b] = p_PB;
    return;
  }
  const auto parent = static_cast<std::size_t>(it.parent);
  R_[b].noalias() = R_[parent] * R_PB;
  p_[b] = p_[parent];
  p_[b].noalias() += R_[parent] * p_PB;
}

// Inertia and joint axis in the world's axes.
void TreeDynamics::weigh(std::size_t b) {
  const TreeBody& it = bodies_[b];
  const Eigen::Matrix3d& R_WB = R_[b];
  const Eigen::Vector3d com = p_[b] + R_WB * it.com;
  composite_[b].mass = it.mass;
  composite_[b].moment = it.mass * com;
  Eigen::Matrix3d turned;
  turned.noalias() = R_WB * it.inertia;
  composite_[b].rotation.noalias() = turned * R_WB.transpose();
  composite_[b].rotation.noalias() -= (it.mass * com) * com.transpose();
  composite_[b].rotation.diagonal().array() += it.mass * com.squaredNorm();
  if (it.coordinate < 0) {
    return;
  }
  const Eigen::Vector3d axis = R_WB * it.axis;
  if (it.arc.is_bent()) {
    const Eigen::Vector3d turn = R_WB * it.arc.turn;
    axis_[b] << turn, axis + (p_[b] + R_WB * it.hinge).cross(turn);
  } else if (it.slides) {
    axis_[b] << Eigen::Vector3d::Zero(), axis;
  } else {
    axis_[b] << axis, (p_[b] + R_WB * it.hinge).cross(axis);
  }
}

// [moment about the origin; force]
TreeDynamics::Vector6 TreeDynamics::times(const Inertia& I, const Vector6& a) {
  Vector6 f;
  f.head<3>() = I.rotation * a.head<3>() + I.moment.cross(a.tail<3>());
  f.tail<3>() = I.mass * a.tail<3>() - I.moment.cross(a.head<3>());
  return f;
}

// Velocity, acceleration at dv/dt = 0, and the force that this motion and the weight need.
void TreeDynamics::move(std::size_t b, const Eigen::VectorXd& v) {
  const TreeBody& it = bodies_[b];
  Vector6& V = velocity_[b];
  Vector6& A = acceleration_[b];
  if (it.parent < 0) {
    V.setZero();
    A.setZero();
  } else {
    V = velocity_[static_cast<std::size_t>(it.parent)];
    A = acceleration_[static_cast<std::size_t>(it.parent)];
  }
  if (it.coordinate >= 0) {
    const Vector6 own = axis_[b] * v[it.coordinate];
    V += own;
    A.head<3>() += V.head<3>().cross(own.head<3>());
    A.tail<3>() += V.head<3>().cross(own.tail<3>()) + V.tail<3>().cross(own.head<3>());
  }
  const Inertia& I = composite_[b];  // still the body's own
  const Vector6 momentum = times(I, V);
  Vector6& f = force_[b];
  f = times(I, A);
  f.head<3>() += V.head<3>().cross(momentum.head<3>()) + V.tail<3>().cross(momentum.tail<3>()) -
                 I.moment.cross(gravity_);
  f.tail<3>() += V.head<3>().cross(momentum.tail<3>()) - I.mass * gravity_;
}

void TreeDynamics::assemble(const Eigen::VectorXd& v, Eigen::MatrixXd& M, Eigen::VectorXd& h) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    move(b, v);
  }
  M.setZero(size_, size_);
  h.resize(size_);
  for (std::size_t b = bodies_.size(); b-- > 0;) {
    const TreeBody& it = bodies_[b];
    if (it.coordinate >= 0) {
      h[it.coordinate] = axis_[b].dot(force_[b]);
      const Vector6 F = times(composite_[b], axis_[b]);
      for (int a = static_cast<int>(b); a >= 0; a = bodies_[static_cast<std::size_t>(a)].parent) {
        const int other = bodies_[static_cast<std::size_t>(a)].coordinate;
        if (other >= 0) {
          M(it.coordinate, other) = M(other, it.coordinate) = axis_[static_cast<std::size_t>(a)].dot(F);
        }
      }
    }
    if (it.parent >= 0) {
      const auto parent = static_cast<std::size_t>(it.parent);
      force_[parent] += force_[b];
      composite_[parent].mass += composite_[b].mass;
      composite_[parent].moment += composite_[b].moment;
      composite_[parent].rotation += composite_[b].rotation;
    }
  }
}

Eigen::Vector3d TreeDynamics::station(int body, const Eigen::Vector3d& p_B) const {
  const auto b = static_cast<std::size_t>(body);
  return p_[b] + R_[b] * p_B;
}

Eigen::Vector3d TreeDynamics::station_velocity(int body, const Eigen::Vector3d& p_W) const {
  const Vector6& V = velocity_[static_cast<std::size_t>(body)];
  return V.tail<3>() + V.head<3>().cross(p_W);
}

Eigen::Vector3d TreeDynamics::station_acceleration(int body, const Eigen::Vector3d& p_W) const {
  const Vector6& A = acceleration_[static_cast<std::size_t>(body)];
  return A.tail<3>() + A.head<3>().cross(p_W) + angular_velocity(body).cross(station_velocity(body, p_W));
}

Eigen::Vector3d TreeDynamics::angular_velocity(int body) const {
  return velocity_[static_cast<std::size_t>(body)].head<3>();
}

Eigen::Matrix3Xd TreeDynamics::station_jacobian(int body, const Eigen::Vector3d& p_W) const {
  Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, size_);
  for (int a = body; a >= 0; a = bodies_[static_cast<std::size_t>(a)].parent) {
    const int coordinate = bodies_[static_cast<std::size_t>(a)].coordinate;
    if (coordinate >= 0) {
      const Vector6& axis = axis_[static_cast<std::size_t>(a)];
      J.col(coordinate) = axis.tail<3>() + axis.head<3>().cross(p_W);
    }
  }
  return J;
}

Eigen::Matrix3Xd TreeDynamics::turn_jacobian(int body) const {
  Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, size_);
  for (int a = body; a >= 0; a = bodies_[static_cast<std::size_t>(a)].parent) {
    const int coordinate = bodies_[static_cast<std::size_t>(a)].coordinate;
    if (coordinate >= 0) {
      J.col(coordinate) = axis_[static_cast<std::size_t>(a)].head<3>();
    }
  }
  return J;
}

void TreeDynamics::add_force(int body, const Eigen::Vector3d& p_W, const Eigen::Vector3d& force,
                             Eigen::VectorXd& Q) const {
  Vector6 wrench;
  wrench << p_W.cross(force), force;
  for (int a = body; a >= 0; a = bodies_[static_cast<std::size_t>(a)].parent) {
    const int coordinate = bodies_[static_cast<std::size_t>(a)].coordinate;
    if (coordinate >= 0) {
      Q[coordinate] += axis_[static_cast<std::size_t>(a)].dot(wrench);
    }
  }
}

void TreeDynamics::add_moment(int body, const Eigen::Vector3d& moment, Eigen::VectorXd& Q) const {
  for (int a = body; a >= 0; a = bodies_[static_cast<std::size_t>(a)].parent) {
    const int coordinate = bodies_[static_cast<std::size_t>(a)].coordinate;
    if (coordinate >= 0) {
      Q[coordinate] += axis_[static_cast<std::size_t>(a)].head<3>().dot(moment);
    }
  }
}

void TreeDynamics::turn_slope(int body, Eigen::Matrix3Xd& slope) const {
  slope.setZero(3, size_);
  const Eigen::Vector3d turn = angular_velocity(body);
  for (int b = body; b >= 0; b = bodies_[static_cast<std::size_t>(b)].parent) {
    const TreeBody& it = bodies_[static_cast<std::size_t>(b)];
    if (it.coordinate >= 0) {
      const Eigen::Vector3d carrier =
          it.parent >= 0 ? angular_velocity(it.parent) : Eigen::Vector3d(Eigen::Vector3d::Zero());
      slope.col(it.coordinate) = axis_[static_cast<std::size_t>(b)].head<3>().cross(turn - carrier);
    }
  }
}

void TreeDynamics::add_moment_slope(int body, const Eigen::Vector3d& moment, Eigen::MatrixXd& K) const {
  const auto carrier = [&](int b) { return bodies_[static_cast<std::size_t>(b)].parent; };
  for (int a = body; a >= 0; a = carrier(a)) {
    const int row = bodies_[static_cast<std::size_t>(a)].coordinate;
    if (row < 0) {
      continue;
    }
    const Eigen::Vector3d turned = axis_[static_cast<std::size_t>(a)].head<3>().cross(moment);
    for (int b = carrier(a); b >= 0; b = carrier(b)) {
      const int column = bodies_[static_cast<std::size_t>(b)].coordinate;
      if (column >= 0) {
        K(row, column) += axis_[static_cast<std::size_t>(b)].head<3>().dot(turned);
      }
    }
  }
}

void TreeDynamics::station_velocity_slope(int body, const Eigen::Vector3d& p_W,
                                          Eigen::Matrix3Xd& slope) const {
  slope.setZero(3, size_);
  const Eigen::Vector3d v = station_velocity(body, p_W);
  for (int b = body; b >= 0;) {
    const TreeBody& it = bodies_[static_cast<std::size_t>(b)];
    const Vector6& axis = axis_[static_cast<std::size_t>(b)];
    if (it.coordinate >= 0) {
      const Eigen::Vector3d J = axis.tail<3>() + axis.head<3>().cross(p_W);
      slope.col(it.coordinate) = axis.head<3>().cross(v);
      if (it.parent >= 0) {
        const Vector6& carrier = velocity_[static_cast<std::size_t>(it.parent)];
        slope.col(it.coordinate) +=
            carrier.head<3>().cross(J) - axis.head<3>().cross(station_velocity(it.parent, p_W));
      }
    }
    b = it.parent;
  }
}

void TreeDynamics::take_rolling(int body, const Eigen::Vector3d& offset, Eigen::Matrix3Xd& slope) const {
  const Eigen::Vector3d turn = velocity_[static_cast<std::size_t>(body)].head<3>();
  for (int b = body; b >= 0; b = bodies_[static_cast<std::size_t>(b)].parent) {
    const int coordinate = bodies_[static_cast<std::size_t>(b)].coordinate;
    if (coordinate >= 0) {
      slope.col(coordinate) -= turn.cross(axis_[static_cast<std::size_t>(b)].head<3>().cross(offset));
    }
  }
}

void TreeDynamics::take_rolling(int body, const Eigen::Vector3d& offset, const Eigen::Vector3d& force,
                                Eigen::MatrixXd& K) const {
  for (int b = body; b >= 0; b = bodies_[static_cast<std::size_t>(b)].parent) {
    const int column = bodies_[static_cast<std::size_t>(b)].coordinate;
    if (column < 0) {
      continue;
    }
    const Eigen::Vector3d moved = axis_[static_cast<std::size_t>(b)].head<3>().cross(offset);
    for (int a = body; a >= 0; a = bodies_[static_cast<std::size_t>(a)].parent) {
      const int row = bodies_[static_cast<std::size_t>(a)].coordinate;
      if (row >= 0) {
        K(row, column) -= force.dot(axis_[static_cast<std::size_t>(a)].head<3>().cross(moved));
      }
    }
  }
}

Eigen::RowVectorXd TreeDynamics::yaw_slope(int body) const {
  Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(size_);
  const Eigen::Vector3d y = rotation(body).col(1);
  const double seen = std::max(y.head<2>().squaredNorm(), 1e-6);  // on its side it has no direction
  for (int b = body; b >= 0; b = bodies_[static_cast<std::size_t>(b)].parent) {
    const int coordinate = bodies_[static_cast<std::size_t>(b)].coordinate;
    if (coordinate >= 0) {
      const Eigen::Vector3d turned = axis_[static_cast<std::size_t>(b)].head<3>().cross(y);
      slope[coordinate] = (y.x() * turned.y() - y.y() * turned.x()) / seen;
    }
  }
  return slope;
}

void TreeDynamics::add_force_slope(int body, const Eigen::Vector3d& p_W, const Eigen::Vector3d& force,
                                   Eigen::MatrixXd& K) const {
  const auto carrier = [&](int b) { return bodies_[static_cast<std::size_t>(b)].parent; };
  for (int a = body; a >= 0; a = carrier(a)) {
    const int row = bodies_[static_cast<std::size_t>(a)].coordinate;
    if (row < 0) {
      continue;
    }
    const Vector6& axis = axis_[static_cast<std::size_t>(a)];
    const Eigen::Vector3d turned = (axis.tail<3>() + axis.head<3>().cross(p_W)).cross(force);  // J_a x force
    for (int b = a; b >= 0; b = carrier(b)) {
      const int column = bodies_[static_cast<std::size_t>(b)].coordinate;
      if (column < 0) {
        continue;
      }
      const double slope = axis_[static_cast<std::size_t>(b)].head<3>().dot(turned);
      K(row, column) += slope;
      if (row != column) {
        K(column, row) += slope;
      }
    }
  }
}

}  // namespace plumbline::model
