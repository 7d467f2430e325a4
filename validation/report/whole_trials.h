// What a model makes of whole trials, beside its errors in windows: in closed loop, and turned round.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/identify/closed_loop/closed_loop.h"
#include "validation/identify/closed_loop/reference.h"
#include "validation/identify/inverse_model/inverse_model.h"
#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

struct WholeTrial {
  std::string trial, data;  ///< name of the trial, and of its data file without folders
  Role role = Role::train;
  ClosedLoop loop;
  InverseModel inverse;
};

/// Where a trial lacks what it takes (controllers, sensors), `not_available` of its part says so.
std::vector<WholeTrial> whole_trials(const model::Model& model, const Data& data);

nlohmann::json to_json(const WholeTrial& trial);
nlohmann::json to_json(const ReferenceValue& value);

}  // namespace plumbline::validation
