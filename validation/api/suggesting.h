// Suggestions as JSON (docs/formats/json-results.md, `suggest`).
#pragma once

#include <nlohmann/json.hpp>

#include "validation/identify/suggest/suggest.h"

namespace plumbline::api {

nlohmann::json to_json(const validation::Suggestions& suggestions);

/// The best experiment is first: when it separates nothing, none does.
bool any_separable(const validation::Suggestions& suggestions);

}  // namespace plumbline::api
