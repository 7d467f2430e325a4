// Closed loops as rows on the joints of the tree: errors, Jacobian, and what is left of their acceleration.
#pragma once

#include <Eigen/Core>
#include <array>
#include <initializer_list>
#include <vector>

#include "simulator/model/mechanism.h"
#include "simulator/model/model.h"

namespace plumbline::model {

/// phi(q) = 0 of all loops; phi'' = J dv/dt + bias, J = dphi/dq over all joints of the tree. Each row is a
/// length in metres. With the points p_1, p_2 of a loop's two links, in the world,
///   connect  three rows: p_2 in the axes of the first link, less where it belongs,
///            e = R_1' (p_2 - p_1),   e' = R_1' (v_2 - v_1),   e'' = R_1' (a_2 - a_1 - 2 w_1 x (v_2 - v_1)),
///            v_1 and a_1 those of the first link's material point at p_2;
///   hinge    the same, and two rows for a second point of the axis, 1 m away; weld: three for two points;
///   rod      one row, (|p_2 - p_1|^2 - length^2) / (2 length).
/// Rows in a link's axes, not the world's: what a planar mechanism cannot violate is then the same
/// combination of rows in all its positions, and is left out (keep()). Source: closure conditions as in E. J.
/// Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, Allyn and Bacon 1989, chapter 9.
class LoopRows {
 public:
  LoopRows(const Skeleton& skeleton, const std::vector<Loop>& loops, const Mechanism& mechanism);

  int size() const { return static_cast<int>(keep_.rows()); }
  /// Of all rows, before keep(); and the loop that each belongs to.
  int all() const { return static_cast<int>(rows_.size()); }
  int loop_of(int row) const { return rows_[static_cast<std::size_t>(row)].loop; }
  /// From now on the rows are combinations of all: size x all().
  void keep(const Eigen::MatrixXd& combinations) { keep_ = combinations; }
  const Eigen::MatrixXd& kept() const { return keep_; }
  /// Of the loops, m: what rounding errors are in proportion to.
  double length() const { return length_; }

  /// At the poses of the tree, m.
  void errors(const TreeDynamics& tree, Eigen::VectorXd& errors);
  /// size() x joints of the tree.
  void jacobian(const TreeDynamics& tree, int joints, Eigen::MatrixXd& J);
  /// At the poses and velocities of the tree, m/s^2.
  void bias(const TreeDynamics& tree, Eigen::VectorXd& bias);

 private:
  struct Point {
    int body = -1;  // of the tree; -1: the world, and the point is in its frame
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  // in the body's frame
  };
  struct Row {
    int loop = 0;
    std::array<Point, 2> at;
    Eigen::Vector3d along = Eigen::Vector3d::Zero();  // in the axes of the first body
    double length = 0.0;                              // of a rod; else 0
  };
  Point point_of(const Mechanism& mechanism, const LoopEnd& end, const Eigen::Vector3d& offset) const;
  void add_point(const Mechanism& mechanism, const Loop& loop, int index, const Eigen::Vector3d& offset,
                 std::initializer_list<int> axes);
  static Eigen::Vector3d station(const TreeDynamics& tree, const Point& at);
  static Eigen::Vector3d turned(const TreeDynamics& tree, const Row& row);

  std::vector<Eigen::Isometry3d> on_world_;  // poses of the skeleton's bodies with all joints at zero
  std::vector<Row> rows_;
  Eigen::MatrixXd keep_, all_J_;
  Eigen::VectorXd all_, row_;
  double length_ = 0.0;
};

}  // namespace plumbline::model
