// How the readings of inertial sensors change with the parameters of their laws.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/model/plant.h"

namespace plumbline::model {

/// Is any of the parameters one of a law of inertial sensors?
bool is_any_inertial(const Model& model, const std::vector<ParameterId>& parameters);

/// Adds d(readings)/d(parameters) by the laws of inertial sensors to D, sensors x parameters, where
/// `readings` is what Plant::outputs() gave. With reading = G actual + b, actual follows from the reading:
///   d(reading) = dG G^-1 (reading - b) + db.
void add_inertial_tangent(const Plant& plant, const Eigen::VectorXd& readings,
                          const std::vector<ParameterId>& parameters, const Eigen::VectorXd& steps,
                          Eigen::MatrixXd& D);

}  // namespace plumbline::model
