// Mass matrix and bias of a tree of rigid bodies from the bodies' poses.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "simulator/model/arc.h"

namespace plumbline::model {

/// A body of the tree and the joint that carries it.
struct TreeBody {
  int parent = -1;          ///< index of the carrying body, before this one; -1: the world
  int coordinate = -1;      ///< of the joint; -1: welded to its parent
  bool slides = false;      ///< prismatic; else revolute
  Eigen::Vector3d axis;     ///< unit vector of the joint, in the body's frame
  Eigen::Vector3d hinge;    ///< a point on the axis, in the body's frame, m
  Arc arc;                  ///< of a slide that is bent, in the body's frame
  Eigen::Isometry3d X_PB;   ///< pose in the parent's (or the world's) frame with the joint at zero
  double mass = 0.0;        ///< kg
  Eigen::Vector3d com;      ///< in the body's frame, m
  Eigen::Matrix3d inertia;  ///< about the centre of mass, in the body's frame, kg m^2
};

/// M(q) dv/dt + h(q, v) = Q by the composite rigid body and the recursive Newton-Euler methods, with all
/// spatial vectors in world axes about the world's origin, where composite inertias are plain sums.
/// Source: R. Featherstone, Rigid Body Dynamics Algorithms, Springer 2008, tables 5.1 and 6.2.
/// Poses by Rodrigues' formula, R(q) = R(0) (I + sin q [a] + (1 - cos q) [a]^2) for a turn by q about axis a.
/// Order of use: place(), then assemble(); stations afterwards. Nothing is allocated after the first use.
class TreeDynamics {
 public:
  TreeDynamics(std::vector<TreeBody> bodies, int coordinates, const Eigen::Vector3d& gravity);

  const std::vector<TreeBody>& bodies() const { return bodies_; }
  int coordinates() const { return size_; }

  /// Poses of all bodies at the joints' positions q.
  void place(const Eigen::VectorXd& q);

  /// M (symmetric, coordinates x coordinates) and h (gravity, Coriolis and centrifugal terms) for rates v.
  void assemble(const Eigen::VectorXd& v, Eigen::MatrixXd& M, Eigen::VectorXd& h);

  /// Orientation of a body in the world.
  const Eigen::Matrix3d& rotation(int body) const { return R_[static_cast<std::size_t>(body)]; }
  /// Position and velocity in the world of a point fixed on a body, m and m/s.
  Eigen::Vector3d station(int body, const Eigen::Vector3d& p_B) const;
  Eigen::Vector3d station_velocity(int body, const Eigen::Vector3d& p_W) const;
  /// Acceleration of a point fixed on a body at dv/dt = 0, m/s^2, and the body's angular velocity, rad/s.
  Eigen::Vector3d station_acceleration(int body, const Eigen::Vector3d& p_W) const;
  Eigen::Vector3d angular_velocity(int body) const;
  /// d(station_velocity)/dv and d(angular_velocity)/dv, 3 x coordinates.
  Eigen::Matrix3Xd station_jacobian(int body, const Eigen::Vector3d& p_W) const;
  Eigen::Matrix3Xd turn_jacobian(int body) const;
  /// The joint's screw, the body's velocity, and its acceleration at dv/dt = 0: spatial vectors [angular;
  /// linear at the world's origin] in the world's axes.
  const Eigen::Matrix<double, 6, 1>& axis(int body) const { return axis_[static_cast<std::size_t>(body)]; }
  const Eigen::Matrix<double, 6, 1>& velocity(int body) const {
    return velocity_[static_cast<std::size_t>(body)];
  }
  const Eigen::Matrix<double, 6, 1>& bias(int body) const {
    return acceleration_[static_cast<std::size_t>(body)];
  }
  /// In the world, m/s^2.
  const Eigen::Vector3d& gravity() const { return gravity_; }
  /// h-convention generalised force of a force that acts on a body at a point: Q += J' force.
  void add_force(int body, const Eigen::Vector3d& p_W, const Eigen::Vector3d& force,
                 Eigen::VectorXd& Q) const;
  /// The same of a moment on the body.
  void add_moment(int body, const Eigen::Vector3d& moment, Eigen::VectorXd& Q) const;
  /// d(angular_velocity)/dq with the rates held, 3 x coordinates: of joint b, whose parent has W,
  /// w_b x (w - W).
  void turn_slope(int body, Eigen::Matrix3Xd& slope) const;
  /// d(moment . w_a)/dq_b with the moment held: K_ab += moment . (w_b x w_a), b before a.
  void add_moment_slope(int body, const Eigen::Vector3d& moment, Eigen::MatrixXd& K) const;
  /// d(J' force)/dq with the force held: K_ab += force . (w_b x J_a), b at or before a on the way from the
  /// world (what a joint turns takes the axes behind it along), and K_ba the same.
  void add_force_slope(int body, const Eigen::Vector3d& p_W, const Eigen::Vector3d& force,
                       Eigen::MatrixXd& K) const;
  /// d(station_velocity)/dq with the rates held, 3 x coordinates: of joint b, whose parent has the angular
  /// velocity W and carries the point along with u, w_b x (v - u) + W x J_b.
  void station_velocity_slope(int body, const Eigen::Vector3d& p_W, Eigen::Matrix3Xd& slope) const;
  /// What is to be taken from station_velocity_slope and add_force_slope, 3 x coordinates and coordinates^2,
  /// where the point is not fixed on the body but `offset` (in the world, held) from one that is, as that of
  /// a rolling sphere: W x (w_b x offset), and force . (w_a x (w_b x offset)).
  void take_rolling(int body, const Eigen::Vector3d& offset, Eigen::Matrix3Xd& slope) const;
  void take_rolling(int body, const Eigen::Vector3d& offset, const Eigen::Vector3d& force,
                    Eigen::MatrixXd& K) const;
  /// d(angle of the body's y axis, seen from above)/dq, 1 x coordinates.
  Eigen::RowVectorXd yaw_slope(int body) const;

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;  // [angular; linear at the world's origin]
  struct Inertia {
    double mass;
    Eigen::Vector3d moment;    // mass times position of the centre of mass
    Eigen::Matrix3d rotation;  // about the world's origin
  };
  /// A body's turn in its parent's frame: R = at_zero + sin(q) sine + (1 - cos(q)) versine.
  struct Turn {
    Eigen::Matrix3d at_zero, sine, versine;
    Eigen::Vector3d origin;  // of the joint in the parent's frame, less what slides
    Eigen::Vector3d slide;   // per metre, in the parent's frame
  };
  static Turn turn_of(const TreeBody& body);
  static Vector6 times(const Inertia& I, const Vector6& a);
  void pose(std::size_t body, const Eigen::VectorXd& q);
  void weigh(std::size_t body);
  void move(std::size_t body, const Eigen::VectorXd& v);

  std::vector<TreeBody> bodies_;
  std::vector<Turn> turns_;
  int size_;
  Eigen::Vector3d gravity_;
  std::vector<Eigen::Matrix3d> R_;
  std::vector<Eigen::Vector3d> p_;
  std::vector<Vector6> axis_, velocity_, acceleration_, force_;
  std::vector<Inertia> composite_;
};

}  // namespace plumbline::model
