// The catalogue as JSON (docs/formats/json.md, `effects`).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "simulator/effects/catalogue.h"

namespace plumbline::api {

/// All laws, or the named one. Throws InputError with the nearest names when it is unknown.
effects::Catalogue named_effects(const std::string& name);

/// "linear", "logarithm", "reciprocal"
std::string to_string(effects::Scale scale);

nlohmann::json effects_json(const effects::Catalogue& catalogue);

}  // namespace plumbline::api
