// Every sample of a hopping run, a row each.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "controllers/mabel_hopping/hopping.h"
#include "simulator/model/plant.h"
#include "simulator/trace/table.h"

namespace plumbline::validation {

/// Columns: t, q_SENSOR (true positions), u_MOTOR, F_FOOT_x, _y, _z (of the ground on the foot), phase,
/// torso_wanted.
class HopRecorder {
 public:
  explicit HopRecorder(const model::Model& model);
  void row(double t, const Eigen::VectorXd& outputs, const Eigen::VectorXd& command,
           const std::vector<model::Touch>& touches, const controllers::Hopping& controller);
  Table table() const;

 private:
  std::vector<Column> columns_;
  std::vector<double> values_;  // row by row
};

}  // namespace plumbline::validation
