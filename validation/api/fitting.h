// A fit of chosen parameters, as JSON and as a model file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/api/loading.h"
#include "validation/identify/fit/fit.h"

namespace plumbline::api {

/// Fits the parameters of the model whose labels match one of the patterns (shell wildcards). Throws
/// InputError with the names when a pattern matches none.
validation::Fit fit(const Loaded& loaded, const std::vector<std::string>& patterns,
                    const validation::FitOptions& options, const validation::Progress& progress);

/// docs/formats/json-results.md, `fit`.
nlohmann::json to_json(const validation::Fit& fit, const Loaded& loaded,
                       const validation::FitOptions& options);

/// The fitted values as an overlay on the model; those that the data do not depend on are left out.
void save(const validation::Fit& fit, const Loaded& loaded, const std::string& file);

}  // namespace plumbline::api
