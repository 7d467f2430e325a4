#include <fmt/core.h>

#include <algorithm>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/fit/scales.h"
#include "validation/twin/twin.h"

namespace plumbline::cli {
namespace {

struct Options {
  std::string effect, at, model, trial, data_folder, out, json;
  std::vector<std::string> set;
};

/// The effect with the values that were set; names and bounds are checked.
model::EffectUse parse(const Options& options, const model::Model& model) {
  std::string text = options.effect + "@" + options.at + ":";
  for (std::size_t i = 0; i < options.set.size(); ++i) {
    text += (i == 0 ? "" : ",") + options.set[i];
  }
  return validation::parse_effect(text, model, model::known_effects());
}

bool is_set(const Options& options, const std::string& parameter) {
  return std::any_of(options.set.begin(), options.set.end(), [&](const std::string& setting) {
    return setting.compare(0, parameter.size() + 1, parameter + "=") == 0;
  });
}

/// From the motion of a train trial where there is one, otherwise from the model alone.
effects::Scales scales_for(const Options& options, const model::Model& model, const model::EffectUse& use) {
  if (!options.trial.empty()) {
    validation::Trial trial = validation::read_trial(options.trial, model, {options.data_folder});
    if (trial.role == validation::Role::train) {
      const validation::Data data({trial}, {});
      return validation::scales_at(model, use.law, use.at, data);
    }
  }
  return validation::scales_at(model, *use.law, use.at);
}

/// The start in the middle of the law's grid, in place of what was not set: the null values for most laws.
void fill_in(const Options& options, const model::Model& model, model::EffectUse& use) {
  const std::vector<effects::Values> starts = use.law->starts(scales_for(options, model, use));
  const effects::Values& start = starts[starts.size() / 2];
  for (std::size_t p = 0; p < use.values.size(); ++p) {
    const effects::Parameter& parameter = use.law->declaration().parameters[p];
    if (!is_set(options, parameter.name)) {
      use.values[p].value = std::clamp(start[p], parameter.lower, parameter.upper);
    }
  }
}

/// Nothing that the overlay would stand on may be replaced by it.
std::vector<std::string> read_files(const model::Model& model) {
  std::vector<std::string> files = model.lineage;
  files.push_back(model.skeleton.file);
  return files;
}

std::string unit_of(const model::Model& model, const model::EffectUse& use,
                    const effects::Parameter& parameter) {
  return effects::unit_at(parameter.unit, model.place_is_angular(model.resolve(*use.law, use.at), use.at));
}

nlohmann::json to_json(const model::EffectUse& use, const model::Model& model, const Options& options) {
  nlohmann::json json{{"file", options.out},
                      {"base", model.file},
                      {"effect", options.effect},
                      {"at", options.at},
                      {"changes_nothing", use.law->is_null(use.numbers().data())},
                      {"values", nlohmann::json::array()}};
  for (std::size_t p = 0; p < use.values.size(); ++p) {
    const effects::Parameter& parameter = use.law->declaration().parameters[p];
    json["values"].push_back({{"name", parameter.name},
                              {"value", json_number(use.values[p].value)},
                              {"unit", unit_of(model, use, parameter)},
                              {"set", is_set(options, parameter.name)},
                              {"structural", parameter.structural}});
  }
  return json;
}

void print(const model::EffectUse& use, const model::Model& model, const Options& options) {
  fmt::print("{}: {} on {}\n\n", options.out, use.label(), model.file);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t p = 0; p < use.values.size(); ++p) {
    const effects::Parameter& parameter = use.law->declaration().parameters[p];
    rows.push_back({parameter.name, fmt::format("{:g}", use.values[p].value), unit_of(model, use, parameter),
                    is_set(options, parameter.name) ? "set" : "start",
                    parameter.structural ? "never fitted" : ""});
  }
  print_table({"parameter", "value", "unit", "from", ""}, rows);
  fmt::print("\n{}\nFit it: plumbline fit TRIAL... --model {} --free '{}@{}:*'\n",
             use.law->is_null(use.numbers().data()) ? "With these values it changes nothing yet."
                                                    : "These values already change the model.",
             options.out, options.effect, options.at);
}

void run(const Options& options) {
  check_writable(options.out);
  check_writable(options.json);
  const std::string base = options.model.empty() ? validation::model_of_trial(options.trial) : options.model;
  const model::Model model = model::read_model(base, model::known_effects());
  check_not_an_input(options.out, read_files(model));
  model::EffectUse use = parse(options, model);
  fill_in(options, model, use);
  model::write_overlay(options.out, base, {{options.effect, options.at, use.numbers()}}, {},
                       use.label() + ", added with start values", model::known_effects());
  write_json(to_json(use, model, options), options.json);
  print(use, model, options);
}

}  // namespace

void add_add(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("add", "A new model file: a model with one effect more, ready to be fitted");
  command->add_option("effect", options->effect, "name from `plumbline effects`")
      ->required()
      ->type_name("EFFECT");
  command->add_option("--at", options->at, "coordinate, motor, ratio, body, sensor, foot, or world")
      ->required()
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
      ->type_name("PARAM=VALUE");
  command->add_option("-o,--out", options->out, "the new model file")->required()->type_name("FILE");
  add_json_option(*command, options->json);
  command->footer(
      "Example:\n  plumbline add coulomb --at mLA --model robots/mabel/leg_bench.yaml -o new.yaml");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
