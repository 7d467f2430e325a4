#include "validation/cli/inputs.h"

#include <fmt/core.h>

#include "validation/cli/files.h"
#include "validation/cli/interrupt.h"
#include "work/workers.h"

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

Loaded load(const Inputs& inputs) {
  check_writable(inputs.json);  // before the work, not after it
  Loaded loaded = api::load(inputs, &stop_flag());
  loaded.data->threads = work::cores();
  return loaded;
}

}  // namespace plumbline::cli
