// The rigid multibody tree: Simbody behind a door that shows numbers only.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/model/tree_dynamics.h"

namespace plumbline::model {

/// Mass matrix and bias of the skeleton's joints (one coordinate per moving joint, in skeleton order):
///   M(q) dv/dt + h(q, v) = Q,   v = dq/dt,
/// h holds Coriolis, centrifugal and gravity terms. Not thread-safe: one object for each thread.
class Mechanism {
 public:
  explicit Mechanism(const Skeleton& skeleton);
  ~Mechanism();
  Mechanism(Mechanism&&) noexcept;
  Mechanism& operator=(Mechanism&&) noexcept;

  /// Number of moving joints.
  int size() const;
  /// Index of a joint's coordinate by its place in skeleton.joints; -1 for fixed joints.
  int coordinate_of_joint(int joint) const;

  /// Index in tree() of a skeleton's body; -1 for bodies fixed to the world.
  int tree_body(int body) const;
  /// Kinematics at the positions and velocities evaluated last.
  const TreeDynamics& tree() const;

  /// M, size() x size(), and h; not a number where a position is none.
  void evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::MatrixXd& M, Eigen::VectorXd& h);

  /// Gravity's potential plus kinetic energy of the links, J.
  double energy(const Eigen::VectorXd& q, const Eigen::VectorXd& v);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumbline::model
