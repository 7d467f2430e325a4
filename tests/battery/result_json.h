// A result as JSON, and back.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/battery/run_case.h"

namespace plumbline::battery {

nlohmann::json to_json(const Result& result);

/// All but the candidates (pairs, ranking, leads), which are not written. Throws std::runtime_error when a
/// key is missing or of the wrong type, or when there is no case of that name any more.
Result result_from(const nlohmann::json& json);

}  // namespace plumbline::battery
