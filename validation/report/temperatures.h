// Temperatures of motors, which no sensor shows, along a trial.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "validation/identify/trial/trial.h"
#include "validation/report/thin.h"

namespace plumbline::validation {

struct Temperature {
  std::string state;       ///< "winding_temperature of thermal_motor at drive"
  Eigen::VectorXd values;  ///< at the trial's samples, K
};

/// What the model makes of the recorded commands, from a cold motor at the beginning of the record, through
/// its gaps. Empty for a model whose laws have no temperatures.
std::vector<Temperature> temperatures(const model::Model& model, const Trial& trial);

/// [{"state", "unit": "K", "values": CURVE}]
nlohmann::json temperatures_json(const model::Model& model, const Trial& trial,
                                 const std::vector<Block>& blocks);

}  // namespace plumbline::validation
