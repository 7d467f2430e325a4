// A run of hops for people and as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "validation/hopping/hop_run.h"

namespace plumbline::cli {

/// docs/formats.md, `hop`: the list "hops".
nlohmann::json hops_json(const validation::HopRun& run);

/// A line for each hop, and how the run ended.
void print_hops(const validation::HopRun& run);

}  // namespace plumbline::cli
