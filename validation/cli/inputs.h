// Options that several commands share, and what they name.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "validation/api/loading.h"

namespace plumbline::cli {

struct Inputs : api::Sources {
  std::string json;
  std::vector<std::string> without;  ///< effects left out of the catalogue
};

/// TRIAL..., --data, --window, --json.
void add_data_inputs(CLI::App& command, Inputs& inputs);
/// The same and --model.
void add_trial_inputs(CLI::App& command, Inputs& inputs);
/// A finite number from `least` to `most` (CLI::Range lets "nan" pass).
CLI::Validator between(double least, double most);
void add_json_option(CLI::App& command, std::string& json);

using api::Loaded;

/// api::load with the stop flag wired to Ctrl-C. Refuses a file of --json that could not be written.
Loaded load(const Inputs& inputs);

}  // namespace plumbline::cli
