// Rods of closed loops that an effect lets stretch.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/model/coordinate_map.h"
#include "simulator/model/loop_rows.h"
#include "simulator/model/mechanism.h"
#include "simulator/model/model.h"
#include "simulator/model/plant_slots.h"

namespace plumbline::model {

/// How far rods are stretched, s = |p_2 - p_1| - length, and ds/dz. A force f along s acts with J' f on the
/// independent coordinates, J = ds/dz: it pulls the two points together where it is negative.
class ReleasedRods {
 public:
  /// Model and map have to outlive the rods.
  ReleasedRods(const Model& model, const CoordinateMap& map) : model_(model), map_(map) {}

  bool empty() const { return rods_.empty(); }
  /// The rod's index from now on; the same for one that was added before.
  int add(const std::string& name, const Mechanism& mechanism);

  /// s near z as a line of it: exact at z, which the tree stands at.
  LinearForm line_at(int rod, const TreeDynamics& tree, const double* z);
  /// dJ/dz, positions x positions, by central differences.
  Eigen::MatrixXd curvature(int rod, const TreeDynamics& tree, const double* z);

 private:
  struct Rod {
    std::string name;
    double length = 0.0;
    LoopRows rows;
  };
  double stretch(Rod& rod, const TreeDynamics& tree, Eigen::VectorXd& slope);

  const Model& model_;
  const CoordinateMap& map_;
  std::vector<Rod> rods_;
  Eigen::VectorXd error_;  // work space
  Eigen::MatrixXd row_;
};

}  // namespace plumbline::model
