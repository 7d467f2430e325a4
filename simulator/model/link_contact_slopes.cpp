// Slopes of the forces between links in contact.
#include <algorithm>
#include <cmath>

#include "simulator/model/link_contacts.h"

namespace plumbline::model {

using Eigen::Isometry3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::Vector4d;

// By the tree's coordinates while their rates are held, 3 x coordinates each.
struct LinkContacts::Turning {
  Matrix3Xd J_first, J_second, J;  // of the material where they meet, J: of the first less the second
  Matrix3Xd W_first, W_second;     // of the links' turns
  Matrix3Xd position, forward, left, normal;
  Matrix3Xd velocity;  // of the first link's material less the second's
};

// Of the force in the axes of the touch and of the states' rates, by [the velocity in these axes; the depth],
// and by the states.
struct LinkContacts::LawSlopes {
  Vector3d force;
  Eigen::Matrix<double, 3, 4> by_motion = Eigen::Matrix<double, 3, 4>::Zero();
  MatrixXd rate_by_motion;  // states x 4
  Matrix3Xd by_state;
  MatrixXd rate_by_state;
};

// By differences of the meeting of the two shapes over the six ways in which a link can move about the point.
void LinkContacts::add_turning(const Slot& slot, const TreeDynamics& tree, const LinkTouch& at, bool of_first,
                               Turning& turn) {
  constexpr double kStep = 1e-6;  // rad or m: far below the shapes' radii, far above rounding
  const int body = of_first ? slot.first.body : slot.second.body;
  if (body < 0) {
    return;
  }
  const Isometry3d X_first = pose_of(slot.first, tree);
  const Isometry3d X_second = pose_of(slot.second, tree);
  const Matrix3Xd& J = of_first ? turn.J_first : turn.J_second;
  const Matrix3Xd& W = of_first ? turn.W_first : turn.W_second;
  for (int k = 0; k < 6; ++k) {
    const auto there = [&](double step) {
      Isometry3d way = Isometry3d::Identity();
      if (k < 3) {
        way.translation()[k] = step;
      } else {
        way = Eigen::Translation3d(at.position) * Eigen::AngleAxisd(step, Vector3d::Unit(k - 3)) *
              Eigen::Translation3d(-at.position);
      }
      return of_first ? meet(slot, way * X_first, X_second) : meet(slot, X_first, way * X_second);
    };
    const LinkTouch plus = there(kStep);
    const LinkTouch minus = there(-kStep);
    const Eigen::RowVectorXd ways = (k < 3 ? J.row(k) : W.row(k - 3)) / (2.0 * kStep);
    const Eigen::Matrix3d axes = plus.axes - minus.axes;
    turn.position += (plus.position - minus.position) * ways;
    turn.forward += axes.col(0) * ways;
    turn.left += axes.col(1) * ways;
    turn.normal += axes.col(2) * ways;
  }
}

LinkContacts::Turning LinkContacts::carried(const Slot& slot, const TreeDynamics& tree, const LinkTouch& at) {
  Turning turn;
  turn.J_first = turn.J_second = turn.W_first = turn.W_second = Matrix3Xd::Zero(3, tree.coordinates());
  if (slot.first.body >= 0) {
    turn.J_first = tree.station_jacobian(slot.first.body, at.position);
    turn.W_first = tree.turn_jacobian(slot.first.body);
  }
  if (slot.second.body >= 0) {
    turn.J_second = tree.station_jacobian(slot.second.body, at.position);
    turn.W_second = tree.turn_jacobian(slot.second.body);
  }
  turn.J = turn.J_first - turn.J_second;
  return turn;
}

void LinkContacts::find_turning(const Slot& slot, const TreeDynamics& tree, const LinkTouch& at,
                                Turning& turn) {
  const Eigen::Index n = tree.coordinates();
  turn.position = turn.forward = turn.left = turn.normal = Matrix3Xd::Zero(3, n);
  add_turning(slot, tree, at, true, turn);
  add_turning(slot, tree, at, false, turn);
  // Of the material that is at the point, which is another one as the point moves over the link.
  const auto of = [&](int body, const Matrix3Xd& J) {
    Matrix3Xd slope = Matrix3Xd::Zero(3, n);
    if (body >= 0) {
      tree.station_velocity_slope(body, at.position, slope);
      const Vector3d spin = tree.angular_velocity(body);
      for (Eigen::Index j = 0; j < n; ++j) {
        slope.col(j) += spin.cross(Vector3d(turn.position.col(j) - J.col(j)));
      }
    }
    return slope;
  };
  turn.velocity = of(slot.first.body, turn.J_first) - of(slot.second.body, turn.J_second);
}

// As wide as the motion is on the way, so that they are means over it (Plant::foot_tangent); `at` and `half`,
// half of what the motion changes, are [velocity in the axes of the touch; depth].
LinkContacts::LawSlopes LinkContacts::law_slopes(const Slot& slot, const Vector4d& at, const Vector4d& half,
                                                 Eigen::VectorXd& x,
                                                 const std::vector<effects::Values>& values) const {
  LawSlopes slopes;
  slopes.rate_by_motion.setZero(states_, 4);
  slopes.by_state.setZero(3, states_);
  slopes.rate_by_state.setZero(states_, states_);
  Eigen::VectorXd up = Eigen::VectorXd::Zero(x.size());
  Eigen::VectorXd down = up;
  const auto force = [&](const Vector4d& motion, double* xdot) {
    return slot.force(motion[3], -motion[2], motion.head<2>(), x.data(), values, xdot);
  };
  slopes.force = force(at, nullptr);
  for (int k = 0; k < 4 && at[3] + std::abs(half[3]) > 0.0; ++k) {
    const double least = k < 3 ? kSpeedStep : std::max(kLeastDepthStep, kShareOfDepth * std::abs(at[3]));
    const double step = std::max(least, std::abs(half[k]));
    const Vector4d way = step * Vector4d::Unit(k);
    slopes.by_motion.col(k) = (force(at + way, up.data()) - force(at - way, down.data())) / (2.0 * step);
    slopes.rate_by_motion.col(k) = (up - down).segment(first_state_, states_) / (2.0 * step);
  }
  for (const ContactLaws::Drag& use : slot.drags) {
    for (int k = use.state; k >= 0 && k < use.state + use.law->state_count(); ++k) {
      const double here = x[k];
      const double step = 1e-7 * (1.0 + std::abs(here));
      x[k] = here + step;
      const Vector3d above = force(at, up.data());
      x[k] = here - step;
      slopes.by_state.col(k - first_state_) = (above - force(at, down.data())) / (2.0 * step);
      x[k] = here;
      slopes.rate_by_state.col(k - first_state_) = (up - down).segment(first_state_, states_) / (2.0 * step);
    }
  }
  return slopes;
}

// d(J' F) = J' dF + (dJ)' F, dF by the laws and by how their axes turn.
void LinkContacts::add_slopes(const Slot& slot, const TreeDynamics& tree, const LinkTouch& at,
                              const Turning& turn, const LawSlopes& laws, LinkSlopes& slopes) {
  const Eigen::Index n = tree.coordinates();
  MatrixXd by_q(4, n);
  MatrixXd by_v = MatrixXd::Zero(4, n);
  by_q.topRows(3) = at.axes.transpose() * turn.velocity;
  by_q.row(0) += at.velocity.transpose() * turn.forward;
  by_q.row(1) += at.velocity.transpose() * turn.left;
  by_q.row(2) += at.velocity.transpose() * turn.normal;
  by_q.row(3) = -at.normal().transpose() * turn.J;
  by_v.topRows(3) = at.axes.transpose() * turn.J;
  const Matrix3Xd turned =
      laws.force.x() * turn.forward + laws.force.y() * turn.left + laws.force.z() * turn.normal;
  slopes.force_by_q += turn.J.transpose() * (at.axes * (laws.by_motion * by_q) + turned);
  slopes.force_by_v += turn.J.transpose() * (at.axes * (laws.by_motion * by_v));
  slopes.force_by_s += turn.J.transpose() * (at.axes * laws.by_state);
  slopes.rate_by_q += laws.rate_by_motion * by_q;
  slopes.rate_by_v += laws.rate_by_motion * by_v;
  const auto add_leverage = [&](int body, const Vector3d& force, const Matrix3Xd& J, const Matrix3Xd& W) {
    if (body < 0 || force.isZero(0.0)) {
      return;
    }
    tree.add_force_slope(body, at.position, force, slopes.force_by_q);
    Matrix3Xd moment(3, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      moment.col(j) = Vector3d(turn.position.col(j) - J.col(j)).cross(force);
    }
    slopes.force_by_q += W.transpose() * moment;
  };
  const Vector3d force = at.axes * laws.force;
  add_leverage(slot.first.body, force, turn.J_first, turn.W_first);
  add_leverage(slot.second.body, -force, turn.J_second, turn.W_second);
}

void LinkContacts::find_slopes(const TreeDynamics& tree, const double* x, Eigen::Index size,
                               const std::vector<effects::Values>& values, const Eigen::VectorXd& dq,
                               const Eigen::VectorXd& dv, LinkSlopes& slopes) const {
  const Eigen::Index n = tree.coordinates();
  slopes.force_by_q.setZero(n, n);
  slopes.force_by_v.setZero(n, n);
  slopes.force_by_s.setZero(n, states_);
  slopes.rate_by_q.setZero(states_, n);
  slopes.rate_by_v.setZero(states_, n);
  slopes.rate_by_s.setZero(states_, states_);
  Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(x, size);
  for (int point = 0; point < points(); ++point) {
    const Slot& slot = slots_[static_cast<std::size_t>(point)];
    const LinkTouch at = touch(point, tree);
    Turning turn = carried(slot, tree, at);
    Vector4d here;
    here << at.axes.transpose() * at.velocity, at.depth;
    Vector4d half;
    half << 0.5 * at.axes.transpose() * (turn.J * dv), -0.5 * at.normal().dot(turn.J * dq);
    const LawSlopes laws = law_slopes(slot, here, half, moved, values);
    slopes.rate_by_s += laws.rate_by_state;
    if (at.depth + std::abs(half[3]) > 0.0) {  // else the bristles straighten, and nothing else
      find_turning(slot, tree, at, turn);
      add_slopes(slot, tree, at, turn, laws, slopes);
    }
  }
}

}  // namespace plumbline::model
