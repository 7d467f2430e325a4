// Rigid contact: points that are held, with the forces that hold them, and the blow of one that is caught.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace plumbline::rigid {

/// Rows J (constraints x coordinates) on the velocities v of a system M dv/dt = Q. Each row is a direction in
/// which a point is held, or a coordinate that is: a pinned foot in the plane has two. Rows may depend on
/// each other (two feet of a robot that stands on both, a direction in which nothing can move): of all forces
/// that hold them the smallest is given then, and rank() says how many are independent.
///
/// With M = L L' and X = L^-1 J', all by the pseudo-inverse X^+, so that neither X' X is formed nor a
/// dependent row divides by zero.
class Constraints {
 public:
  /// M: symmetric, positive definite. Throws std::invalid_argument where it is not, or where sizes differ.
  void set(const Eigen::MatrixXd& M, const Eigen::MatrixXd& J);

  struct Motion {
    Eigen::VectorXd acceleration;  ///< dv/dt
    Eigen::VectorXd reaction;      ///< lambda, one for each row: N at a point, N m at an angle
  };
  /// M dv/dt = Q + J' lambda with J dv/dt + bias = 0; bias = (dJ/dt) v.
  Motion hold(const Eigen::VectorXd& Q, const Eigen::VectorXd& bias) const;

  struct Impact {
    Eigen::VectorXd velocity;  ///< just after
    Eigen::VectorXd impulse;   ///< Lambda, one for each row: N s at a point, N m s at an angle
    double lost = 0.0;         ///< kinetic energy, J; never below zero
  };
  /// The rigid impact without rebound and slip, in no time: M (v+ - v) = J' Lambda with J v+ = 0.
  /// Source: Y. Hurmuzlu, D. B. Marghitu, Rigid body collisions of planar kinematic chains with multiple
  /// contact points, Int. J. Robotics Research 13 (1994); as used by Sreenath et al., A compliant hybrid zero
  /// dynamics controller for stable, efficient and fast bipedal walking on MABEL (2011), equations 16 to 18.
  Impact strike(const Eigen::VectorXd& v) const;

  /// Smallest change of positions, by the mass matrix, that takes J dq = -error.
  Eigen::VectorXd correction(const Eigen::VectorXd& error) const;

  int rank() const { return rank_; }

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd J_, X_, pseudo_inverse_;
  int rank_ = 0;
};

/// How a foot that is pinned would fare on a real floor.
struct FootLoad {
  double normal = 0.0;    ///< along the floor's normal, away from it, N or N s
  double friction = 0.0;  ///< |along the floor|, N or N s

  bool lifts() const { return normal < 0.0; }
  /// friction/normal; infinite where nothing presses.
  double needed_friction() const;
  /// Inside the cone of a floor with this coefficient of friction.
  bool holds(double coefficient) const { return normal >= 0.0 && friction <= coefficient * normal; }
};

/// Of a force (or impulse) on a foot in the world's axes; normal: unit vector.
FootLoad foot_load(const Eigen::Vector3d& force, const Eigen::Vector3d& normal = Eigen::Vector3d::UnitZ());

}  // namespace plumbline::rigid
