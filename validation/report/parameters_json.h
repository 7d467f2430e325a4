// The free parameters of a fitted model, how sure they are, and what the data cannot tell.
#pragma once

#include <nlohmann/json.hpp>

#include "validation/identify/diagnose/screen.h"
#include "validation/identify/predict/deviations.h"

namespace plumbline::validation {

/// {"windows", "confidence", "parameters": [...], "correlation": matrix or null}; docs/formats.md, "The data
/// of a report". `given` is the model before anything was fitted or added to it. Without free parameters or
/// train windows both lists are empty. `precision` is that of the stage's parameters; of another size: from
/// the slopes at its estimate.
nlohmann::json parameters_json(const model::Model& given, const Stage& stage, const Precision& precision,
                               const Data& data);

}  // namespace plumbline::validation
