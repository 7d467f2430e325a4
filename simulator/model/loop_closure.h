// Positions in which a model's loops are closed.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "simulator/model/loop_rows.h"

namespace plumbline::model {

/// The closed loops of a model over the positions z that ratios and locks leave, q = S z + q0. Geometry is
/// the skeleton's. Not thread-safe: one object for each thread.
class LoopClosure {
 public:
  /// Of some or all loops of the model: finds a position in which they are closed, near Model::loops_near
  /// (joints not named: zero). Throws InputError, with file and line of the loop, when none is found, when a
  /// loop can never close, and when it holds only what joints, locks or other loops hold already.
  LoopClosure(const Model& model, std::vector<Loop> loops, const Eigen::MatrixXd& S,
              const Eigen::VectorXd& q0);

  int size() const { return rows_.size(); }
  LoopRows& rows() { return rows_; }
  /// That a row of errors() is of.
  const Loop& loop_of(int row) const;
  /// Where the loops are closed first.
  const Eigen::VectorXd& home() const { return home_; }

  /// phi(z), m, and dphi/dz, size() x positions.
  const Eigen::VectorXd& errors(const Eigen::VectorXd& z);
  const Eigen::MatrixXd& jacobian(const Eigen::VectorXd& z);

  /// The z near the given one at which |C z - y|^2 is least among those that close the loops; what C leaves
  /// open moves as little as it can. Gauss-Newton in the loops' tangent space. False when the loops do not
  /// close to rounding (1e-12 of their size).
  bool close(const Eigen::MatrixXd& C, const Eigen::VectorXd& y, Eigen::VectorXd& z);
  /// The velocities w with J(z) w = 0 at which |C w - y|^2 is least.
  Eigen::VectorXd velocities(const Eigen::MatrixXd& C, const Eigen::VectorXd& y, const Eigen::VectorXd& z);
  /// Are the loops closed to rounding?
  bool is_closed(const Eigen::VectorXd& z);

 private:
  void place(const Eigen::VectorXd& z);
  void leave_out_what_always_holds();
  void find_home(const Model& model);
  void refuse_redundant();
  Eigen::VectorXd step(const Eigen::MatrixXd& C, const Eigen::VectorXd& miss, const Eigen::VectorXd& z,
                       bool exact);
  Eigen::VectorXd somewhere(double reach);

  std::vector<Loop> loops_;
  Eigen::MatrixXd S_;
  Eigen::VectorXd q0_;
  Mechanism mechanism_;
  LoopRows rows_;
  Eigen::VectorXd home_, q_, v_, h_, errors_;
  Eigen::MatrixXd M_, J_, tree_J_;
  unsigned long long draws_ = 1;  // state of a small generator: the same positions every time
};

}  // namespace plumbline::model
