// What a model does at random states: two that do the same there are the same.
#pragma once

#include <Eigen/Core>

#include "simulator/model/model.h"

namespace plumbline::validation {

/// Rates at states whose velocities reach over six decades, so that what happens close to rest counts, too.
Eigen::VectorXd rates_at_random_states(const model::Model& model);

}  // namespace plumbline::validation
