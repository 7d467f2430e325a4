// Where a force jumps: a surface in the space of positions.
#pragma once

#include <Eigen/Core>

#include "simulator/model/plant.h"

namespace plumbline::validation {

/// A switching function g of a plant at a state: its value, d(g)/d(positions), and d(g)/dt.
struct JumpSurface {
  double value = 0.0;
  Eigen::RowVectorXd slope;
  double rate = 0.0;
};
JumpSurface surface_at(model::Plant& plant, int index, const Eigen::VectorXd& x);

/// d(state)/dt a hair beside the surface: side +1 where g is above zero, -1 below.
Eigen::VectorXd rate_beside(model::Plant& plant, const JumpSurface& surface, const Eigen::VectorXd& x,
                            const double* command, double side);

/// A first state that rests so close to a stop's edge that the sensors cannot tell on which side it is begins
/// on the side to which the forces of both press it, one deviation of g away and at rest: a pulley that its
/// preload holds in the stop leaves it later than one that lies on the edge, and a search that begins on the
/// wrong side does not find over. `deviations`: of the positions; `period`: of a sample, s.
void begin_inside(model::Plant& plant, const double* command, const Eigen::VectorXd& deviations,
                  double period, Eigen::VectorXd& x);

}  // namespace plumbline::validation
