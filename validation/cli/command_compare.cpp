#include <fmt/core.h>

#include "validation/cli/commands.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/compare/compare.h"
#include "validation/report/result_json.h"

namespace plumbline::cli {
namespace {

using validation::ChannelError;
using validation::Comparison;
using validation::WindowError;

void print(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const ChannelError& c : comparison.channels) {
    rows.push_back({c.trial, to_string(c.role), c.name, fmt::format("{:.4g} {}", c.rms, c.unit),
                    fmt::format("{:.3g} {}", c.floor, c.unit), fmt::format("{:.2f}", c.ratio)});
  }
  fmt::print("Residual of each channel, predicted in windows from their own start:\n\n");
  print_table({"trial", "role", "channel", "rms", "floor", "rms/floor"}, rows);
  fmt::print("\nWorst windows:\n\n");
  rows.clear();
  for (std::size_t i = 0; i < std::min<std::size_t>(5, comparison.windows.size()); ++i) {
    const WindowError& w = comparison.windows[i];
    rows.push_back({w.trial, fmt::format("{:.2f} to {:.2f} s", w.from, w.to), fmt::format("{:.2f}", w.ratio),
                    w.worst_channel});
  }
  print_table({"trial", "window", "error/floor", "worst channel"}, rows);
  fmt::print(
      "\nError in units of the floor (1: what the sensors alone leave): train {:.3f}, held-out {:.3f}\n",
      comparison.scores.train, comparison.scores.held_out);
}

}  // namespace

void add_compare(CLI::App& app, Outcome& /*outcome*/) {
  auto inputs = std::make_shared<Inputs>();
  CLI::App* command = app.add_subcommand("compare", "Where the model fails: per channel and time window");
  add_trial_inputs(*command, *inputs);
  command->footer(
      "Example:\n  plumbline compare demo/siso_mLA demo/mimo --model robots/mabel/leg_bench.yaml");
  command->callback([inputs] {
    const Loaded loaded = load(*inputs, catalogue_for(*inputs));
    const Comparison comparison = validation::compare(loaded.model, *loaded.data);
    write_json(validation::to_json(comparison), inputs->json);
    print(comparison);
  });
}

}  // namespace plumbline::cli
