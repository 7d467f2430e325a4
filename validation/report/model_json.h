// A model's values with unit, uncertainty and source, as JSON (docs/formats.md, `check`).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::validation {

/// What `plumbline check` writes of a model, but for the numbers that need the equations of motion.
nlohmann::json model_json(const model::Model& model);

/// The unit of a law's parameter where the effect sits.
std::string unit_of(const model::Model& model, const model::EffectUse& use, std::size_t parameter);

const std::vector<effects::Place>& all_places();

}  // namespace plumbline::validation
