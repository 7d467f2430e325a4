#include "validation/cli/inputs.h"

#include <fmt/core.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/cli/files.h"
#include "validation/cli/interrupt.h"
#include "validation/inverse_model/inverse_model.h"

namespace plumbline::cli {

void add_json_option(CLI::App& command, std::string& json) {
  command.add_option("--json", json, "write what is printed to FILE, machine-readable")->type_name("FILE");
}

CLI::Validator between(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        double value = 0.0;
        const bool inside = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return inside ? "" : fmt::format("found {}, expected a number from {} to {}", text, least, most);
      },
      fmt::format("FLOAT in [{} - {}]", least, most));
}

void add_data_inputs(CLI::App& command, Inputs& inputs) {
  command.add_option("trial", inputs.trials, "trial folders (or their trial.yaml)")
      ->required()
      ->type_name("TRIAL");
  command.add_option("--data", inputs.data_folder, "folder with the trials' data files")->type_name("DIR");
  command.add_option("--window", inputs.window, "length of the prediction windows, s")
      ->capture_default_str()
      ->check(between(1e-9, 1e99));
  add_json_option(command, inputs.json);
}

void add_trial_inputs(CLI::App& command, Inputs& inputs) {
  add_data_inputs(command, inputs);
  command.add_option("--model", inputs.model, "model file in place of the one the trials name")
      ->type_name("FILE");
}

effects::Catalogue catalogue_for(const Inputs& inputs) {
  effects::Catalogue catalogue = model::known_effects();
  for (const std::string& name : inputs.without) {
    if (!catalogue.find(name)) {
      std::vector<std::string> known;
      for (const auto& law : catalogue.laws()) {
        known.push_back(law->declaration().name);
      }
      throw InputError("--without: unknown effect '" + name + "'" + nearest_names(name, known));
    }
    catalogue = catalogue.without(name);
  }
  return catalogue;
}

Loaded load(const Inputs& inputs, const effects::Catalogue& catalogue) {
  check_writable(inputs.json);  // before the work, not after it
  const std::string file =
      inputs.model.empty() ? validation::model_of_trial(inputs.trials.front()) : inputs.model;
  Loaded loaded{model::read_model(file, catalogue), nullptr};
  validation::TrialOptions options;
  options.data_folder = inputs.data_folder;
  std::vector<validation::Trial> trials;
  for (const std::string& path : inputs.trials) {
    trials.push_back(validation::read_trial(path, loaded.model, options));
    validation::check_command_units(loaded.model, trials.back());
  }
  validation::check_roles(trials);
  validation::PredictOptions predict;
  predict.window = inputs.window;
  loaded.data = std::make_unique<validation::Data>(std::move(trials), predict);
  loaded.data->stop = &stop_flag();
  return loaded;
}

}  // namespace plumbline::cli
