// What a model or a trial is, in words and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "simulator/model/model.h"
#include "validation/trial/trial.h"

namespace plumbline::cli {

/// What is left to move once ratios and locks have been taken into account.
struct Freedom {
  int coordinates = 0, states = 0;
};

/// Throws InputError when ratios or locks contradict each other or the mass matrix is singular.
Freedom freedom_of(const model::Model& model, const std::vector<validation::Lock>& locks);

nlohmann::json to_json(const model::Model& model, const Freedom& freedom);
void print(const model::Model& model, const Freedom& freedom);

nlohmann::json to_json(const validation::Trial& trial, const model::Model& model, const Freedom& freedom);
void print(const validation::Trial& trial, const model::Model& model, const Freedom& freedom);

}  // namespace plumbline::cli
