#include "simulator/model/tree_slopes.h"

namespace plumbline::model {
namespace {

using Spatial = Eigen::Matrix<double, 6, 1>;
using Spatial6 = Eigen::Matrix<double, 6, 6>;

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d cross;
  cross << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return cross;
}

// a x b of two motions.
Spatial cross_motion(const Spatial& a, const Spatial& b) {
  Spatial product;
  product.head<3>() = a.head<3>().cross(b.head<3>());
  product.tail<3>() = a.head<3>().cross(b.tail<3>()) + a.tail<3>().cross(b.head<3>());
  return product;
}

// a x* f of a motion and a force [moment; force].
Spatial cross_force(const Spatial& a, const Spatial& f) {
  Spatial product;
  product.head<3>() = a.head<3>().cross(f.head<3>()) + a.tail<3>().cross(f.tail<3>());
  product.tail<3>() = a.head<3>().cross(f.tail<3>());
  return product;
}

// a x, as a matrix.
Spatial6 cross_matrix_of(const Spatial& a) {
  Spatial6 cross = Spatial6::Zero();
  cross.topLeftCorner<3, 3>() = cross.bottomRightCorner<3, 3>() = cross_matrix(a.head<3>());
  cross.bottomLeftCorner<3, 3>() = cross_matrix(a.tail<3>());
  return cross;
}

}  // namespace

// About the world's origin: m, m p and the rotational inertia of a composite rigid body.
TreeSlopes::Matrix6 TreeSlopes::inertia_of(const TreeDynamics& tree, int body, const TreeBody& it) {
  Matrix6 I = Matrix6::Zero();
  if (it.mass == 0.0 && it.inertia.isZero(0.0)) {
    return I;
  }
  const Eigen::Matrix3d& R = tree.rotation(body);
  const Eigen::Matrix3d moment = cross_matrix(it.mass * tree.station(body, it.com));
  I.topLeftCorner<3, 3>() =
      R * it.inertia * R.transpose() - moment * cross_matrix(tree.station(body, it.com));
  I.topRightCorner<3, 3>() = moment;
  I.bottomLeftCorner<3, 3>() = -moment;
  I.bottomRightCorner<3, 3>().diagonal().setConstant(it.mass);
  return I;
}

void TreeSlopes::add_body(const TreeDynamics& tree, int body, const Eigen::VectorXd& a) {
  const TreeBody& it = tree.bodies()[static_cast<std::size_t>(body)];
  Link& link = links_[static_cast<std::size_t>(body)];
  link.parent = it.parent;
  link.coordinate = it.coordinate;
  link.axis = tree.axis(body);
  link.velocity = tree.velocity(body);
  // What the accelerations of the joints up to here add; the parent's has it less its own bias.
  link.acceleration = tree.bias(body);
  if (it.parent >= 0) {
    link.acceleration += links_[static_cast<std::size_t>(it.parent)].acceleration - tree.bias(it.parent);
  } else {
    link.acceleration.tail<3>() -= tree.gravity();
  }
  link.axis_rate.setZero();
  link.axis_pull.setZero();
  if (it.coordinate >= 0) {
    link.acceleration += link.axis * a[it.coordinate];
    link.axis_rate = cross_motion(link.velocity, link.axis);
    link.axis_pull = cross_motion(link.acceleration, link.axis) + cross_motion(link.velocity, link.axis_rate);
  }
  inertias_[static_cast<std::size_t>(body)] = inertia_of(tree, body, it);
}

void TreeSlopes::set(const TreeDynamics& tree, const Eigen::VectorXd& a) {
  const std::size_t n = tree.bodies().size();
  size_ = tree.coordinates();
  links_.resize(n);
  inertias_.resize(n);
  loads_.resize(n);
  for (std::size_t b = 0; b < n; ++b) {
    add_body(tree, static_cast<int>(b), a);
  }
}

void TreeSlopes::weigh(const Link& link, Load& load) {
  if (load.inertia.isZero(0.0)) {
    load.force.setZero();
    load.coriolis.setZero();
    return;
  }
  const Matrix6 V = cross_matrix_of(link.velocity);
  const Vector6 momentum = load.inertia * link.velocity;
  load.force = load.inertia * link.acceleration + cross_force(link.velocity, momentum);
  load.coriolis.noalias() = -load.inertia * V;
  load.coriolis.noalias() -= V.transpose() * load.inertia;
  const Eigen::Matrix3d linear = cross_matrix(momentum.tail<3>());
  load.coriolis.topLeftCorner<3, 3>() -= cross_matrix(momentum.head<3>());
  load.coriolis.topRightCorner<3, 3>() -= linear;
  load.coriolis.bottomLeftCorner<3, 3>() -= linear;
}

void TreeSlopes::inverse_dynamics(Eigen::MatrixXd& by_position, Eigen::MatrixXd& by_velocity) {
  by_position.setZero(size_, size_);
  by_velocity.setZero(size_, size_);
  for (std::size_t b = 0; b < links_.size(); ++b) {
    loads_[b].inertia = inertias_[b];
    weigh(links_[b], loads_[b]);
  }
  for (std::size_t b = links_.size(); b-- > 0;) {
    const Link& link = links_[b];
    const Load& load = loads_[b];
    if (link.coordinate >= 0) {
      const Vector6 pressed = load.inertia * link.axis;
      const Vector6 turned = load.coriolis.transpose() * link.axis;
      const Vector6 by_q =
          cross_force(link.axis, load.force) + load.inertia * link.axis_pull + load.coriolis * link.axis_rate;
      const Vector6 by_v = 2.0 * (load.inertia * link.axis_rate) + load.coriolis * link.axis;
      for (int c = static_cast<int>(b); c >= 0; c = links_[static_cast<std::size_t>(c)].parent) {
        const Link& carrier = links_[static_cast<std::size_t>(c)];
        if (carrier.coordinate < 0) {
          continue;
        }
        by_position(link.coordinate, carrier.coordinate) =
            pressed.dot(carrier.axis_pull) + turned.dot(carrier.axis_rate);
        by_velocity(link.coordinate, carrier.coordinate) =
            2.0 * pressed.dot(carrier.axis_rate) + turned.dot(carrier.axis);
        if (carrier.coordinate != link.coordinate) {
          by_position(carrier.coordinate, link.coordinate) = carrier.axis.dot(by_q);
          by_velocity(carrier.coordinate, link.coordinate) = carrier.axis.dot(by_v);
        }
      }
    }
    if (link.parent >= 0) {
      Load& carrier = loads_[static_cast<std::size_t>(link.parent)];
      carrier.inertia += load.inertia;
      carrier.coriolis += load.coriolis;
      carrier.force += load.force;
    }
  }
}

void TreeSlopes::add_other_mass(const TreeDynamics& tree, int body, const TreeBody& other,
                                Eigen::VectorXd& Q) const {
  const auto b = static_cast<std::size_t>(body);
  const Matrix6 more = inertia_of(tree, body, other) - inertias_[b];
  const Vector6 force =
      more * links_[b].acceleration + cross_force(links_[b].velocity, more * links_[b].velocity);
  for (int c = body; c >= 0; c = links_[static_cast<std::size_t>(c)].parent) {
    const Link& carrier = links_[static_cast<std::size_t>(c)];
    if (carrier.coordinate >= 0) {
      Q[carrier.coordinate] += carrier.axis.dot(force);
    }
  }
}

// A turn of joint j moves the whole body as a rigid one, which its own axes do not see; what is left is
// dV = psi_j and dA = eta_j + psi_j x V.
void TreeSlopes::felt_at(int body, const Eigen::Vector3d& p_W, Felt& felt) const {
  felt.turn_by_position.setZero(3, size_);
  felt.pull_by_position.setZero(3, size_);
  felt.pull_by_velocity.setZero(3, size_);
  const Vector6 V = links_[static_cast<std::size_t>(body)].velocity;
  const Eigen::Vector3d turn = V.head<3>();
  const Eigen::Vector3d speed = V.tail<3>() + turn.cross(p_W);
  const auto pull = [&](const Vector6& dV, const Vector6& dA) -> Eigen::Vector3d {
    return dA.tail<3>() + dA.head<3>().cross(p_W) + dV.head<3>().cross(speed) +
           turn.cross(dV.tail<3>() + dV.head<3>().cross(p_W));
  };
  for (int j = body; j >= 0; j = links_[static_cast<std::size_t>(j)].parent) {
    const Link& link = links_[static_cast<std::size_t>(j)];
    if (link.coordinate < 0) {
      continue;
    }
    felt.turn_by_position.col(link.coordinate) = link.axis_rate.head<3>();
    felt.pull_by_position.col(link.coordinate) =
        pull(link.axis_rate, link.axis_pull + cross_motion(link.axis_rate, V));
    felt.pull_by_velocity.col(link.coordinate) =
        pull(link.axis, 2.0 * link.axis_rate + cross_motion(link.axis, V));
  }
}

}  // namespace plumbline::model
