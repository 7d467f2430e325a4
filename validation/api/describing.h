// What a model or a trial is, as JSON (docs/formats/json.md, `check`).
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "simulator/model/model.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::api {

/// What is left to move once ratios and locks have been taken into account.
struct Freedom {
  int coordinates = 0, states = 0;
};

/// Throws InputError when ratios or locks contradict each other or the mass matrix is singular.
Freedom freedom_of(const model::Model& model, const std::vector<validation::Lock>& locks);

nlohmann::json to_json(const model::Model& model, const Freedom& freedom);
nlohmann::json to_json(const validation::Trial& trial, const model::Model& model, const Freedom& freedom);

/// Root mean square of a channel.
double rms(const Eigen::VectorXd& values);

}  // namespace plumbline::api
