#include <fmt/core.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "validation/api/suggesting.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

using api::any_separable;
using validation::Separation;
using validation::Suggestions;

std::string seconds_text(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{:.1f} s", seconds) : "never";
}

void print_explanations(const Suggestions& suggestions) {
  fmt::print("Explanations of these trials (error in units of the floor):\n\n");
  std::vector<std::vector<std::string>> rows;
  for (const validation::Explanation& one : suggestions.explanations) {
    rows.push_back(
        {one.name, fmt::format("{:.3f}", one.scores.train), fmt::format("{:.3f}", one.scores.held_out)});
  }
  print_table({"effect", "train", "held-out"}, rows);
}

void print_experiments(const Suggestions& suggestions) {
  fmt::print(
      "\nWhat would tell them apart, best first ({} that would leave the range of the motion are left "
      "out):\n\n",
      suggestions.refused);
  std::vector<std::vector<std::string>> rows;
  for (const Separation& one : suggestions.experiments) {
    rows.push_back({one.name, fmt::format("{:.0f} %", 100.0 * one.share), fmt::format("{:.2f}", one.error),
                    seconds_text(one.seconds)});
  }
  print_table({"experiment", "of the reach", "the wrong one leaves", "tells after"}, rows);
}

void print(const Suggestions& suggestions) {
  print_explanations(suggestions);
  if (any_separable(suggestions)) {
    print_experiments(suggestions);
  }
  for (const auto& [one, other] : suggestions.inseparable) {
    fmt::print("\nNo experiment tells {} from {}: on this robot, with these sensors, they are one answer.\n",
               one, other);
  }
}

}  // namespace

void add_suggest(CLI::App& app, Outcome& /*outcome*/) {
  struct Options {
    Inputs inputs;
    std::vector<std::string> between;
    std::string save;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("suggest", "Which experiment would tell effects apart that explain the same trials");
  add_trial_inputs(*command, options->inputs);
  command->add_option("--between", options->between, "effects at places, as diagnose names them")
      ->required()
      ->expected(2, 6)
      ->type_name("EFFECT@WHERE");
  command->add_option("--save", options->save, "write the best experiment to FILE")->type_name("FILE");
  command->footer(
      "Example:\n  plumbline suggest demo/siso_mLA demo/mimo --between preload@leg_angle torque_bias@mLA "
      "--save next.yaml");
  command->callback([options] {
    check_writable(options->save);
    const Loaded loaded = load(options->inputs);
    Suggestions suggestions;
    {
      ProgressLine progress;
      suggestions = validation::suggest(loaded.model, model::known_effects(), *loaded.data, options->between,
                                        progress.callback());
    }
    write_json(api::to_json(suggestions), options->inputs.json);
    if (!options->save.empty() && any_separable(suggestions)) {
      write_text_atomically(options->save, suggestions.experiments.front().text);
    }
    print(suggestions);
  });
}

}  // namespace plumbline::cli
