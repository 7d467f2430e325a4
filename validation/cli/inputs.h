// Options that several commands share, and what they name.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "simulator/effects/catalogue.h"
#include "simulator/model/model.h"
#include "validation/predict/problem.h"

namespace plumbline::cli {

struct Inputs {
  std::vector<std::string> trials;
  std::string model;  ///< empty: the model that the first trial names
  std::string data_folder;
  std::string json;
  double window = 0.5;               ///< s
  std::vector<std::string> without;  ///< effects left out of the catalogue
};

/// TRIAL..., --data, --window, --json.
void add_data_inputs(CLI::App& command, Inputs& inputs);
/// The same and --model.
void add_trial_inputs(CLI::App& command, Inputs& inputs);
/// A finite number from `least` to `most` (CLI::Range lets "nan" pass).
CLI::Validator between(double least, double most);
void add_json_option(CLI::App& command, std::string& json);

effects::Catalogue catalogue_for(const Inputs& inputs);

struct Loaded {
  model::Model model;
  std::unique_ptr<validation::Data> data;
};

/// Reads the model and the trials, checks roles and whether the commands' units can be right, and cuts
/// windows; the stop flag is wired to Ctrl-C.
Loaded load(const Inputs& inputs, const effects::Catalogue& catalogue);

}  // namespace plumbline::cli
