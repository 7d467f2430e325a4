// The rigid bodies of a model on its independent coordinates: mass matrix, bias, closed loops.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "simulator/model/coordinate_map.h"
#include "simulator/model/loop_closure.h"
#include "simulator/model/mechanism.h"
#include "simulator/model/model.h"
#include "simulator/model/plant_slots.h"

namespace plumbline::model {

/// What the effects of structure leave of the bodies: the tree, and inertia that is constant.
struct BodyStructure {
  std::unique_ptr<Mechanism> mechanism;
  Eigen::VectorXd extra_inertia;  ///< on all full coordinates, diagonal
  Eigen::MatrixXd extra_reduced;  ///< S' (diag + pulleys) S
};

/// M = S' M_full S, h and the rows J of closed loops at a state, kept until another is asked for:
///   M a = Q - h + J' lambda,   J a + (dJ/dt) w = 0.
/// Of a state x only the positions and velocities in front are read.
class RigidBodies {
 public:
  using Factor = Eigen::LLT<Eigen::MatrixXd>;

  /// Model, values of its effects and map have to outlive the bodies.
  RigidBodies(const Model& model, const std::vector<effects::Values>& values, const CoordinateMap& map);

  /// After the values of an effect of structure have changed; is this effect one?
  void rebuild();
  bool depend_on(int effect) const;
  /// With the values as they are now.
  BodyStructure make_structure() const;
  const BodyStructure& structure() const { return structure_; }
  /// Others in the place of these; nothing is known of them.
  void swap(BodyStructure& other);
  bool sits_at_base(int effect) const;
  /// Throws InputError where the mass matrix is singular.
  void check_mass_matrix();

  /// M, h and the tree's kinematics at x; factor_at also M's factor and the loops' rows.
  void rigid_at(const double* x);
  void factor_at(const double* x);
  /// What was evaluated last is not to be taken for what stands at the same x.
  void forget() { rigid_known_ = false; }
  /// M and h of any structure at x; nothing is known afterwards.
  void evaluate(const double* x, BodyStructure& structure, Eigen::MatrixXd& M, Eigen::VectorXd& h);
  const Eigen::MatrixXd& M() const { return M_; }
  const Eigen::VectorXd& h() const { return h_; }
  const Factor& factor() const { return factor_; }
  const Mechanism& mechanism() const { return *structure_.mechanism; }
  const TreeDynamics& tree() const { return structure_.mechanism->tree(); }
  /// Of the bodies alone, where rigid_at() was called, J.
  double energy(const double* x) const;
  /// Throws std::runtime_error where a chart is at its singularity.
  void check_charts() const;

  /// M a = Q + J' lambda with J a + (dJ/dt) w = 0.
  void accelerate(const Eigen::VectorXd& Q, Eigen::VectorXd& acceleration) const;
  /// What further forces add to the acceleration.
  Eigen::VectorXd accelerated(const Eigen::VectorXd& Q) const;
  void accelerate_in_place(Eigen::MatrixXd& Q) const;

  /// Rods that an effect lets stretch hold nothing.
  void make_loops();
  /// Are there loops that hold the bodies?
  bool has_loops() const { return held_ != nullptr; }
  /// Of the loops that hold, and of all, rods at their length; null where there are none.
  LoopClosure* held() const { return held_.get(); }
  LoopClosure* closure() const { return closure_.get(); }
  std::unique_ptr<LoopClosure> own_closure() const;
  Eigen::VectorXd home() const;
  /// As those of Plant.
  double close_loops(double* x);
  Eigen::Vector2d loop_errors(const double* x);
  Eigen::MatrixXd closing_slope(const double* x);
  /// What of a force the loops do not carry: Q + J' lambda with the lambda that leaves least of it, or with a
  /// given one.
  Eigen::VectorXd beside_loops(const Eigen::VectorXd& Q, const Eigen::VectorXd& z, Eigen::VectorXd& lambda);
  Eigen::VectorXd with_loops(const Eigen::VectorXd& Q, const Eigen::VectorXd& z,
                             const Eigen::VectorXd& lambda);
  /// Newton's step of an equilibrium: force + K move + J' dlambda = 0, phi + J move = 0, where K is
  /// d(Q + J' lambda)/dz with lambda held.
  Eigen::VectorXd move_along_loops(const Eigen::MatrixXd& K, const Eigen::VectorXd& force,
                                   const Eigen::VectorXd& z);
  /// d(acceleration)/d(z, w) with the force Q held, where it is a0 at x; positions x 2 positions.
  void loop_slope(const double* x, const Eigen::VectorXd& Q, const Eigen::VectorXd& a0,
                  Eigen::MatrixXd& slope);

 private:
  void apply_change(const StructureSlot& slot, Skeleton& skeleton, Eigen::VectorXd& inertia) const;
  bool planar_base_is_bent() const;
  void hold_loops();

  const Model& model_;
  const std::vector<effects::Values>& values_;
  const CoordinateMap& map_;
  const int n_tree_, nz_;
  std::vector<int> charts_;  // full coordinates that are a chart's pitch
  std::vector<StructureSlot> structures_;
  BodyStructure structure_;

  // Work space of the last evaluation.
  Eigen::VectorXd q_, v_, h_tree_, h_;
  Eigen::MatrixXd M_, M_tree_, SM_;
  Factor factor_;
  Eigen::VectorXd known_;  // positions and velocities that q_, v_, M_, h_ and the tree's kinematics belong to
  bool rigid_known_ = false, factored_ = false;

  std::shared_ptr<LoopClosure> closure_, held_;
  Eigen::MatrixXd loop_J_, loop_Y_, loop_tree_J_;  // dphi/dz, M^-1 J' at the position of factor_
  Eigen::VectorXd loop_bias_;                      // (dJ/dt) w
  Factor loop_factor_;                             // J M^-1 J'
};

}  // namespace plumbline::model
