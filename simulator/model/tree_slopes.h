// How inverse dynamics and the motion of points change with positions and velocities, in closed form.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/model/tree_dynamics.h"

namespace plumbline::model {

/// Slopes of Q(q, v, a) = M(q) a + h(q, v), the acceleration a = dv/dt held, and of what is felt at a point.
/// With the joints' axes S, spatial velocities V and accelerations A (less gravity), composite inertias I^c
/// and forces f^c in world axes about the world's origin,
///   psi_j = V_j x S_j,  eta_j = A_j x S_j + V_j x psi_j,  B_i = V_i x* I_i - I_i V_i x + (. x* I_i V_i),
///   dQ_k/dq_j = S_k . (I^c_k eta_j + B^c_k psi_j),  dQ_k/dv_j = S_k . (2 I^c_k psi_j + B^c_k S_j)
/// where j carries k or is k, and where k carries j
///   dQ_k/dq_j = S_k . (S_j x* f^c_j + I^c_j eta_j + B^c_j psi_j), dQ_k/dv_j = S_k . (2 I^c_j psi_j + B^c_j
///   S_j).
/// Every joint is a screw that is fixed in its two bodies, bent slides as well; a floating base is the chain
/// of six (joint_chain.h). The work grows with bodies times depth.
/// Sources: J. Carpentier, N. Mansard, Analytical Derivatives of Rigid Body Dynamics Algorithms, RSS 2018;
/// S. Singh, R. Russell, P. Wensing, IEEE Robotics and Automation Letters 7 (2022) 1776, whose psi' are psi.
class TreeSlopes {
 public:
  /// Of a tree that is placed and assembled, at accelerations a (rad/s^2 or m/s^2) of its coordinates. The
  /// tree may move on afterwards.
  void set(const TreeDynamics& tree, const Eigen::VectorXd& a);

  /// dQ/dq and dQ/dv, coordinates x coordinates; N m or N for each rad, m, rad/s or m/s.
  void inverse_dynamics(Eigen::MatrixXd& by_position, Eigen::MatrixXd& by_velocity);

  /// Adds to Q what the same motion needs more where `other` is in a body's place, which differs in mass,
  /// centre of mass and inertia only. `tree` is as it was for set().
  void add_other_mass(const TreeDynamics& tree, int body, const TreeBody& other, Eigen::VectorXd& Q) const;

  /// Of an angular velocity, rad/s, and of an acceleration less gravity, m/s^2, in axes that turn with the
  /// body, written in the world's: R d(R' w) and R d(R' (p'' - g)) by q and by v, 3 x coordinates.
  struct Felt {
    Eigen::Matrix3Xd turn_by_position, pull_by_position, pull_by_velocity;
  };
  /// At a point fixed on a body, at p_W in the world.
  void felt_at(int body, const Eigen::Vector3d& p_W, Felt& felt) const;

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;  // [angular; linear at the world's origin]
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  struct Link {
    int parent, coordinate;
    Vector6 axis, velocity, acceleration;  // less gravity
    Vector6 axis_rate, axis_pull;          // psi, eta
  };
  struct Load {  // of a body and all that it carries
    Matrix6 inertia, coriolis;
    Vector6 force;
  };
  void add_body(const TreeDynamics& tree, int body, const Eigen::VectorXd& a);
  static Matrix6 inertia_of(const TreeDynamics& tree, int body, const TreeBody& it);
  static void weigh(const Link& link, Load& load);

  int size_ = 0;
  std::vector<Link> links_;
  std::vector<Load> loads_;  // work space
  std::vector<Matrix6> inertias_;
};

}  // namespace plumbline::model
