#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/recipe_report.h"
#include "validation/fit/fit.h"

namespace plumbline::cli {
namespace {

using validation::Doubt;
using validation::Fit;
using validation::FittedParameter;

struct Options {
  Inputs inputs;
  std::vector<std::string> free;
  std::string out;
  validation::FitOptions fit;
  std::string recipe;
  std::optional<std::uint64_t> seed;
};

nlohmann::json to_json(const FittedParameter& parameter) {
  nlohmann::json json{{"label", parameter.label},
                      {"unit", parameter.unit},
                      {"before", json_number(parameter.before)},
                      {"after", json_number(parameter.after)},
                      {"standard_deviation", json_number(parameter.deviation)},
                      {"degrees_of_freedom", json_number(parameter.degrees_of_freedom)},
                      {"interval", {json_number(parameter.lower), json_number(parameter.upper)}},
                      {"partner", parameter.partner},
                      {"correlation", parameter.correlation},
                      {"doubts", nlohmann::json::array()}};
  for (const Doubt& doubt : parameter.doubts) {
    json["doubts"].push_back({{"kind", doubt.kind}, {"text", doubt.text}});
  }
  return json;
}

/// A score of trials that are not there is null.
nlohmann::json to_json(const validation::Scores& scores, const validation::Data& data) {
  nlohmann::json json{{"train", scores.train}, {"held_out", nullptr}, {"test", nullptr}};
  if (scores.test > 0.0) {
    json["test"] = scores.test;
  }
  if (data.has(validation::Role::held_out)) {
    json["held_out"] = scores.held_out;
  }
  return json;
}

nlohmann::json to_json(const Fit& fit, const Loaded& loaded, const Options& options) {
  nlohmann::json json{{"model", loaded.model.file},
                      {"trials", options.inputs.trials},
                      {"before", to_json(fit.before, *loaded.data)},
                      {"after", to_json(fit.after, *loaded.data)},
                      {"windows", fit.windows},
                      {"confidence", options.fit.confidence},
                      {"iterations", fit.iterations},
                      {"converged", fit.converged},
                      {"parameters", nlohmann::json::array()}};
  for (const FittedParameter& parameter : fit.parameters) {
    json["parameters"].push_back(to_json(parameter));
  }
  if (!options.out.empty()) {
    json["saved"] = options.out;
  }
  return json;
}

std::string partner_text(const FittedParameter& parameter) {
  return parameter.partner.empty() ? ""
                                   : fmt::format("{:.2f} with {}", parameter.correlation, parameter.partner);
}

void print_doubts(const Fit& fit) {
  bool any = false;
  for (const FittedParameter& parameter : fit.parameters) {
    for (const Doubt& doubt : parameter.doubts) {
      if (!any) {
        fmt::print("\nWhat these data cannot tell:\n");
        any = true;
      }
      fmt::print("  {}: {}\n", parameter.label, doubt.text);
    }
  }
  if (!any) {
    fmt::print("\nThe data tell every one of these parameters.\n");
  }
}

/// Of all parameters, "12" or "4 to 12".
std::string freedom_text(const Fit& fit) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const FittedParameter& p : fit.parameters) {
    least = std::min(least, p.degrees_of_freedom);
    most = std::max(most, p.degrees_of_freedom);
  }
  const std::string low = fmt::format("{:.0f}", least);
  const std::string high = fmt::format("{:.0f}", most);
  return low == high ? low : low + " to " + high;
}

void print(const Fit& fit, const Loaded& loaded, const Options& options) {
  std::vector<std::vector<std::string>> rows;
  for (const FittedParameter& p : fit.parameters) {
    rows.push_back({p.label, p.unit, fmt::format("{:.4g}", p.before), fmt::format("{:.4g}", p.after),
                    fmt::format("{:.4g} to {:.4g}", p.lower, p.upper), partner_text(p)});
  }
  print_table({"parameter", "unit", "before", "after",
               fmt::format("{:g} % interval", 100.0 * options.fit.confidence), "strongest correlation"},
              rows);
  fmt::print(
      "\nIntervals from the scatter between {} windows ({} degrees of freedom) and from how the error "
      "rises.\n",
      fit.windows, freedom_text(fit));
  if (!fit.converged) {
    fmt::print("Not settled after {} iterations: the values may still move (--iterations).\n",
               fit.iterations);
  }
  print_doubts(fit);
  fmt::print("\nError in units of the floor: train {:.3f} before, {:.3f} after", fit.before.train,
             fit.after.train);
  if (loaded.data->has(validation::Role::held_out)) {
    fmt::print("; held-out {:.3f} before, {:.3f} after\n", fit.before.held_out, fit.after.held_out);
  } else {
    fmt::print("; no held-out trial\n");
  }
  if (fit.after.test > 0.0) {
    fmt::print("On the trials of role test: {:.3f} before, {:.3f} after\n", fit.before.test, fit.after.test);
  }
  if (fit.after.train > options.fit.explained) {
    fmt::print(
        "More is missing than values (above {:g} floors): the intervals do not know of that. What it may be "
        "says plumbline diagnose.\n",
        options.fit.explained);
  }
  if (!options.out.empty()) {
    fmt::print("Model with the new values: {}\n", options.out);
  }
}

/// "fit on chirp, steps": the trials that were fitted.
std::string source_text(const validation::Data& data) {
  std::string text;
  for (const validation::Trial& trial : data.trials) {
    if (trial.role == validation::Role::train) {
      text += (text.empty() ? "fit on " : ", ") + trial.name;
    }
  }
  return text;
}

void save_model(const Fit& fit, const Loaded& loaded, const std::string& file) {
  const std::string source = source_text(*loaded.data);
  std::vector<model::NewValue> values;
  for (const FittedParameter& parameter : fit.parameters) {
    if (parameter.seen()) {
      values.push_back({parameter.label, parameter.after, parameter.deviation, parameter.unit, source});
    }
  }
  model::write_overlay(file, loaded.model.file, {}, values, "values " + source, model::known_effects());
}

void run(const Options& options) {
  check_writable(options.out);
  check_writable(options.inputs.json);
  const Loaded loaded = load(options.inputs, model::known_effects());
  check_not_an_input(options.out, loaded.model.lineage);
  const auto parameters = validation::matching(validation::free_parameters(loaded.model), options.free);
  Fit fit;
  {
    ProgressLine progress;
    fit = validation::fit(loaded.model, *loaded.data, parameters, options.fit, progress.callback());
  }
  if (!options.out.empty()) {
    save_model(fit, loaded, options.out);
  }
  write_json(to_json(fit, loaded, options), options.inputs.json);
  print(fit, loaded, options);
}

/// A whole identification sequence; status 1 when a target was missed.
void run_recipe(const Options& options, Outcome& outcome) {
  check_writable(options.inputs.json);
  const validation::Recipe recipe = validation::read_recipe(options.recipe, model::known_effects());
  validation::RecipeOptions recipe_options;
  recipe_options.seed = options.seed;
  recipe_options.method.confidence = options.fit.confidence;
  recipe_options.method.iterations = options.fit.iterations;
  recipe_options.method.stop = &stop_flag();
  validation::RecipeResult result;
  {
    ProgressLine progress;
    result = validation::run_recipe(recipe, recipe_options, progress.callback());
  }
  write_json(recipe_json(recipe, result, options.fit.confidence), options.inputs.json);
  print_recipe(recipe, result, options.fit.confidence);
  outcome.status = targets_met(recipe, result) ? 0 : 1;
}

/// Either trials and what to free, or a recipe.
void check_usage(const CLI::App& command, const Options& options) {
  if (options.recipe.empty()) {
    for (const char* needed : {"trial", "--free"}) {
      if (command.count(needed) == 0) {
        throw CLI::RequiredError(needed);
      }
    }
    if (options.seed) {
      throw CLI::RequiresError("--seed", "--recipe");
    }
    return;
  }
  for (const char* other : {"trial", "--free", "--out", "--model", "--data", "--window"}) {
    if (command.count(other) > 0) {
      throw CLI::ExcludesError("--recipe", other);
    }
  }
}

}  // namespace

void add_fit(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("fit", "Estimate parameters, how sure they are, and what the data cannot tell");
  add_trial_inputs(*command, options->inputs);
  command->get_option("trial")->required(false);  // a recipe names its own
  command
      ->add_option(
          "--free", options->free,
          "parameters to fit: a pattern (* and ?) over EFFECT@PLACE:PARAMETER; may be given several times")
      ->type_name("PATTERN");
  command->add_option("--recipe", options->recipe, "carry out an identification sequence in place of one fit")
      ->type_name("FILE");
  command->add_option("--seed", options->seed, "of the true values and the noise of a recipe's twins");
  command->add_option("-o,--out", options->out, "write the fitted values as an overlay on the model")
      ->type_name("FILE");
  command->add_option("--iterations", options->fit.iterations, "most iterations of the solver")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->footer(
      "Example:\n  plumbline fit demo/siso_mLA demo/mimo --free 'viscous@*:damping' -o fitted.yaml\n"
      "  plumbline fit --recipe validation/recipes/mabel --seed 7");
  command->callback([options, command, &outcome] {
    check_usage(*command, *options);
    options->recipe.empty() ? run(*options) : run_recipe(*options, outcome);
  });
}

}  // namespace plumbline::cli
