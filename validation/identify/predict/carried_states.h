// Initial states that were found with one model, for another of the same robot.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// The windows' initial states `x0` of the model `from` as states of the model `to`, which has other effects:
/// what both have, by name, as it is there; what is new (bristles) as the measurements say. Empty where a
/// ratio was released: what the rigid one made of the motion says nothing of where its sides are.
std::vector<Eigen::VectorXd> carried_states(const model::Model& from, const model::Model& to,
                                            const Data& data, const std::vector<Eigen::VectorXd>& x0);

}  // namespace plumbline::validation
