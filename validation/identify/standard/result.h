// A standard identification as JSON and as a model file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "validation/identify/standard/standard_fit.h"

namespace plumbline::validation {

/// model, before and after (train, held_out, test: floor units), torques, cutoff (Hz), samples, at_limits,
/// unseen, and of each value label, unit, stated, spread, value, standard_deviation, lower, upper, seen,
/// at_limit.
nlohmann::json to_json(const StandardFit& fit, const Data& data);

/// An overlay on the model's file: values of its own effects that moved, and the added effects that are not
/// at their null values. Throws InputError as model::write_overlay does.
void save(const StandardFit& fit, const Data& data, const std::string& file);

}  // namespace plumbline::validation
