#include <fmt/core.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/api/adding.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/report/model_json.h"

namespace plumbline::cli {
namespace {

struct Options {
  std::vector<std::string> effects, set;
  std::string at, model, trial, data_folder, out, json;
};

/// An effect as it was asked for, and as it is added.
struct Added {
  api::Addition asked;
  model::EffectUse use;
};

/// Nothing that the overlay would stand on may be replaced by it.
std::vector<std::string> read_files(const model::Model& model) {
  std::vector<std::string> files = model.lineage;
  files.push_back(model.skeleton.file);
  return files;
}

void print(const Added& added, const model::Model& model, const Options& options) {
  const model::EffectUse& use = added.use;
  fmt::print("{}: {} on {}\n\n", options.out, use.label(), model.file);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t p = 0; p < use.values.size(); ++p) {
    const effects::Parameter& parameter = use.law->declaration().parameters[p];
    rows.push_back({parameter.name, fmt::format("{:g}", use.values[p].value),
                    validation::unit_of(model, use, p),
                    api::is_set(added.asked, parameter.name) ? "set" : "start",
                    parameter.structural ? "never fitted" : ""});
  }
  print_table({"parameter", "value", "unit", "from", ""}, rows);
  fmt::print("\n{}\n\n", use.law->is_null(use.numbers().data()) ? "With these values it changes nothing yet."
                                                                : "These values already change the model.");
}

void run(const Options& options) {
  check_writable(options.out);
  check_writable(options.json);
  const std::string base = options.model.empty() ? validation::model_of_trial(options.trial) : options.model;
  const model::Model model = model::read_model(base, model::known_effects());
  check_not_an_input(options.out, read_files(model));
  std::optional<validation::Trial> trial;
  if (!options.trial.empty()) {
    trial = validation::read_trial(options.trial, model, {options.data_folder});
  }
  std::vector<Added> all;
  std::vector<model::EffectUse> uses;
  nlohmann::json list = nlohmann::json::array();
  for (const std::string& effect : options.effects) {
    const api::Addition asked = api::addition_of(effect, options.at, options.set);
    all.push_back({asked, api::added_effect(asked, model, trial)});
    uses.push_back(all.back().use);
    list.push_back(api::to_json(uses.back(), model, asked));
  }
  api::save(uses, model, options.out);
  nlohmann::json json =
      all.size() == 1 ? list.front() : nlohmann::json{{"base", model.file}, {"effects", list}};
  json["file"] = options.out;
  write_json(json, options.json);
  std::string free;
  for (const Added& one : all) {
    print(one, model, options);
    free += fmt::format("{}'{}@{}:*'", free.empty() ? "" : " ", one.asked.effect, one.asked.at);
  }
  fmt::print("Fit: plumbline fit TRIAL... --model {} --free {}\n", options.out, free);
}

}  // namespace

void add_add(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("add", "A new model file: a model with further effects, ready to be fitted");
  command
      ->add_option("effects", options->effects,
                   "names from `plumbline effects`; several as EFFECT@PLACE or EFFECT@PLACE:PARAM=VALUE,...")
      ->required()
      ->type_name("EFFECT");
  CLI::Option* at =
      command
          ->add_option("--at", options->at,
                       "where one EFFECT sits: coordinate, motor, ratio, body, sensor, foot, limb, or world")
          ->type_name("WHERE");
  CLI::Option_group* base = command->add_option_group("base", "the model that it is added to");
  base->add_option("--model", options->model, "model file")->type_name("FILE");
  base->add_option("--trial", options->trial,
                   "trial whose model is taken and whose motion gives the start values (with --model: the "
                   "motion only)")
      ->type_name("TRIAL");
  base->require_option(1, 2);
  command->add_option("--data", options->data_folder, "folder with the trial's data files")->type_name("DIR");
  command
      ->add_option("--set", options->set,
                   "value of a parameter, SI units of the place; may be given several times")
      ->type_name("PARAM=VALUE")
      ->needs(at);
  command->add_option("-o,--out", options->out, "the new model file")->required()->type_name("FILE");
  add_json_option(*command, options->json);
  command->footer(
      "Example:\n  plumbline add coulomb --at mLA --model robots/mabel/leg_bench.yaml -o new.yaml\n"
      "  plumbline add coulomb@mLA viscous@mLS:damping=0.01 --model robots/mabel/leg_bench.yaml -o new.yaml");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
