#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "simulator/model/known_effects.h"
#include "validation/api/fitting.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/recipe_report.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/standard/result.h"

namespace plumbline::cli {
namespace {

using validation::Doubt;
using validation::Fit;
using validation::FittedParameter;
using validation::FreeValue;
using validation::StandardFit;

struct Options {
  Inputs inputs;
  std::vector<std::string> free;
  std::string out;
  validation::FitOptions fit;
  std::string recipe;
  std::optional<std::uint64_t> seed;
  bool standard = false;
  validation::StandardOptions cutoffs;
};

nlohmann::json json_of(const Fit& fit, const Loaded& loaded, const Options& options) {
  nlohmann::json json = api::to_json(fit, loaded, options.fit);
  json["trials"] = options.inputs.trials;
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
        fmt::print("\nNot identifiable from these data, or hardly:\n");
        any = true;
      }
      fmt::print("  {}: {}\n", parameter.label, doubt.text);
    }
  }
  if (!any) {
    fmt::print("\nAll of these parameters are identifiable from these data.\n");
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
  if (fit.whole) {
    fmt::print("\nIntervals from drawing the {} recordings with replacement.\n", fit.windows);
  } else {
    fmt::print(
        "\nIntervals from the scatter between {} windows ({} degrees of freedom) and from how the error "
        "rises.\n",
        fit.windows, freedom_text(fit));
  }
  if (!fit.converged) {
    fmt::print("Not settled after {} iterations: the values may still move (--iterations).\n",
               fit.iterations);
  }
  print_doubts(fit);
  fmt::print("\n{} in units of the floor: train {:.3f} before, {:.3f} after",
             fit.whole ? "Mean error of a recording in one piece" : "Error", fit.before.train,
             fit.after.train);
  if (loaded.data->has(validation::Role::held_out)) {
    fmt::print("; held-out {:.3f} before, {:.3f} after\n", fit.before.held_out, fit.after.held_out);
  } else {
    fmt::print("; no held-out trial\n");
  }
  if (fit.after.test > 0.0) {
    fmt::print("On the trials of role test: {:.3f} before, {:.3f} after\n", fit.before.test, fit.after.test);
  }
  if (validation::judged(fit.after, *loaded.data) > validation::judged(fit.before, *loaded.data)) {
    fmt::print(
        "The values before predict better than those after: the model as it was is the one to keep.\n");
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

void run(const Options& options) {
  check_writable(options.out);
  check_writable(options.inputs.json);
  const Loaded loaded = load(options.inputs);
  check_not_an_input(options.out, loaded.model.lineage);
  Fit fit;
  {
    ProgressLine progress;
    fit = api::fit(loaded, options.free, options.fit, progress.callback());
  }
  if (!options.out.empty()) {
    api::save(fit, loaded, options.out);
  }
  write_json(json_of(fit, loaded, options), options.inputs.json);
  print(fit, loaded, options);
}

std::string limits_text(const FreeValue& value) {
  if (!value.seen) {
    return "as stated: these torques do not depend on it";
  }
  return value.at_limit ? fmt::format("at its limit, {:.4g}", value.value) : "";
}

void print_values(const StandardFit& fit) {
  std::vector<std::vector<std::string>> rows;
  for (const FreeValue& value : fit.free.values) {
    rows.push_back({value.label, value.unit, fmt::format("{:.4g} +- {:.2g}", value.stated, value.spread),
                    fmt::format("{:.4g} +- {:.2g}", value.value, value.deviation), limits_text(value)});
  }
  print_table({"value", "unit", "stated", "identified", ""}, rows);
  fmt::print(
      "\n{} values; {} at a limit, {} as stated because nothing depends on them. Deviations take what is "
      "left of "
      "the torques for noise.\n",
      fit.free.values.size(), fit.at_limits(), fit.unseen());
}

void print_torques(const StandardFit& fit) {
  std::vector<std::vector<std::string>> rows;
  for (const validation::TorqueError& torque : fit.torques) {
    const auto share = [&](double rms) {
      return fmt::format("{:.3g} {} ({:.1f} %)", rms, torque.unit, 100.0 * rms / torque.recorded);
    };
    rows.push_back({torque.motor, fmt::format("{:.3g} {}", torque.recorded, torque.unit),
                    share(torque.before), share(torque.after)});
  }
  fmt::print("\nTorque that the motion needs less the recorded one, below {:g} Hz, {} samples, rms:\n\n",
             fit.cutoff, fit.samples);
  print_table({"motor", "recorded", "before", "after"}, rows);
}

void print(const StandardFit& fit, const Loaded& loaded, const std::string& out) {
  print_values(fit);
  print_torques(fit);
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
  if (!out.empty()) {
    fmt::print("Model with the new values: {}\n", out);
  }
}

/// Everything that the regressor of rigid bodies and motors holds, at once.
void run_standard(const Options& options) {
  check_writable(options.out);
  const Loaded loaded = load(options.inputs);
  check_not_an_input(options.out, loaded.model.lineage);
  validation::StandardFit fit;
  {
    ProgressLine progress;
    fit = validation::standard_fit(loaded.model, *loaded.data, options.cutoffs, progress.callback());
  }
  if (!options.out.empty()) {
    validation::save(fit, *loaded.data, options.out);
  }
  nlohmann::json json = validation::to_json(fit, *loaded.data);
  json["trials"] = options.inputs.trials;
  if (!options.out.empty()) {
    json["saved"] = options.out;
  }
  write_json(json, options.inputs.json);
  print(fit, loaded, options.out);
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

/// Trials and what to free, or trials and --standard, or a recipe.
void check_usage(const CLI::App& command, const Options& options) {
  if (options.standard) {
    for (const char* other : {"--free", "--recipe", "--seed", "--iterations", "--whole"}) {
      if (command.count(other) > 0) {
        throw CLI::ExcludesError("--standard", other);
      }
    }
    if (command.count("trial") == 0) {
      throw CLI::RequiredError("trial");
    }
    return;
  }
  if (command.count("--cutoff") > 0) {
    throw CLI::RequiresError("--cutoff", "--standard");
  }
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
  for (const char* other : {"trial", "--free", "--out", "--model", "--data", "--window", "--whole"}) {
    if (command.count(other) > 0) {
      throw CLI::ExcludesError("--recipe", other);
    }
  }
}

}  // namespace

void add_fit(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("fit", "Estimate parameters, how sure they are, and what is not identifiable");
  add_trial_inputs(*command, options->inputs);
  command->get_option("trial")->required(false);  // a recipe names its own
  command
      ->add_option(
          "--free", options->free,
          "parameters to fit: a pattern (* and ?) over EFFECT@PLACE:PARAMETER; may be given several times")
      ->type_name("PATTERN");
  command->add_flag(
      "--standard", options->standard,
      "in place of --free: masses, centres of mass, rotor inertias, torque constants, friction and "
      "offsets at once, by least squares on the torques");
  command
      ->add_option(
          "--cutoff", options->cutoffs.force_cutoff,
          "of --standard: frequency below which torques are compared, Hz; left out, the one whose values "
          "predict the train windows best")
      ->check(CLI::PositiveNumber);
  command->add_flag(
      "--whole", options->fit.whole,
      "simulate each recording in one piece and search without derivatives: for motions through "
      "many impacts, where no slope can be followed");
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
      "  plumbline fit demo/mimo --standard -o identified.yaml\n"
      "  plumbline fit --recipe validation/studies/recipes/mabel --seed 7");
  command->callback([options, command, &outcome] {
    check_usage(*command, *options);
    if (options->standard) {
      run_standard(*options);
    } else if (options->recipe.empty()) {
      run(*options);
    } else {
      run_recipe(*options, outcome);
    }
  });
}

}  // namespace plumbline::cli
