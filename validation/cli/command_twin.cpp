#include <fmt/core.h>

#include <filesystem>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/table.h"
#include "validation/api/twins.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/identify/trial/write_trial.h"

namespace plumbline::cli {
namespace {

struct TwinInputs {
  std::string model;
  std::vector<std::string> with, experiments;
  std::string out, truth, json;
  validation::TwinOptions twin;
};

/// What was hidden, for whoever checks a diagnosis; no command reads it.
nlohmann::json truth_of(const TwinInputs& inputs) {
  return {{"model", inputs.model}, {"with", inputs.with}, {"seed", inputs.twin.seed}};
}

void run(const TwinInputs& inputs) {
  check_writable(inputs.truth);
  check_writable(inputs.json);
  const model::Model model = model::read_model(inputs.model, model::known_effects());
  const model::Model robot = api::with_effects(model, inputs.with);
  nlohmann::json json{{"trials", nlohmann::json::array()}};
  validation::TwinOptions options = inputs.twin;
  for (const std::string& file : inputs.experiments) {
    const std::string folder =
        (std::filesystem::path(inputs.out) / std::filesystem::path(file).stem()).string();
    const validation::Trial trial = api::twin(model, robot, file, options);
    ++options.seed;  // each trial has its own noise
    validation::write_trial(trial, model, folder);
    fmt::print("{}: {} samples, {} channels, role {}\n", folder, trial.samples(), trial.measured.size(),
               to_string(trial.role));
    json["trials"].push_back(folder);
  }
  if (!inputs.truth.empty()) {
    write_text_atomically(inputs.truth, truth_of(inputs).dump(2) + "\n");
  }
  write_json(json, inputs.json);
}

}  // namespace

void add_twin(CLI::App& app, Outcome& /*outcome*/) {
  auto inputs = std::make_shared<TwinInputs>();
  CLI::App* command = app.add_subcommand(
      "twin", "Synthetic measurements from a model, with its sensors' quantisation and noise");
  CLI::Option_group* model = command->add_option_group("model", "the model that plays the robot");
  model->add_option("--model", inputs->model, "model file")->type_name("FILE");
  model->add_option("model", inputs->model)->group("");  // as it was written before
  model->require_option(1);
  command->add_option("--with", inputs->with, "effect to hide in the data: EFFECT@WHERE:param=value,...")
      ->type_name("EFFECT");
  command
      ->add_option("--experiment", inputs->experiments,
                   "experiment files: what to command, from where, how long")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--out", inputs->out, "folder for the trials, one folder for each experiment")
      ->required()
      ->type_name("DIR");
  command->add_option("--truth", inputs->truth, "write what was hidden to FILE (no command reads it)")
      ->type_name("FILE");
  command->add_option("--seed", inputs->twin.seed, "seed of the sensors' noise")->capture_default_str();
  command->add_option("--tolerance", inputs->twin.relative_tolerance, "relative tolerance of the simulation")
      ->capture_default_str();
  add_json_option(*command, inputs->json);
  command->footer(
      "Example:\n  plumbline twin --model robots/mabel/leg_bench.yaml --with "
      "cable_stretch@leg_angle:stiffness=3.5,damping=0.09 "
      "--experiment robots/mabel/experiments/siso_mLA.yaml -o twin");
  command->callback([inputs] { run(*inputs); });
}

}  // namespace plumbline::cli
