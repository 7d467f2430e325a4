// A motion to be drawn: positions over time, and what the ground did.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/model/plant.h"
#include "simulator/trace/table.h"

namespace plumbline::render {

struct Motion {
  Eigen::VectorXd time;                       ///< s, ascending
  Eigen::MatrixXd positions;                  ///< independent ones of the plant, positions x samples
  std::vector<Eigen::Matrix3Xd> foot_forces;  ///< of the ground on each foot of the model, N; may be empty
  std::vector<int> phase;                     ///< of each sample; may be empty
};

/// Sets the phases of a motion by the feet that the ground pushes, and returns their names: "flight" and
/// "stance", or "stance on left + right" where there are several feet. Without forces there are none.
std::vector<std::string> phases_by_contact(const model::Model& model, Motion& motion);

/// The motion in a trace that `plumbline hop` or `plumbline simulate` wrote: t; q_SENSOR and x_NAME
/// (coordinates, motors, pulleys), as far as the model knows them; F_FOOT_x, _y, _z; phase. Other columns are
/// not read. Throws InputError when t is missing or does not ascend, and when the columns leave a position
/// open.
Motion motion_from(const Table& trace, const model::Plant& plant);

}  // namespace plumbline::render
