#include <fmt/core.h>

#include <cmath>

#include "simulator/trace/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/studies/running/ladder.h"
#include "validation/studies/running/running_file.h"

namespace plumbline::cli {
namespace {

namespace th = plumbline::monopod;
using validation::DesignedRunning;

struct Options {
  std::string file, output, base, json;
  int iterations = 200;
  bool verbose = false;
};

void print(const validation::RunningDesignFile& file, const DesignedRunning& done,
           const std::vector<double>& open, const std::vector<double>& closed) {
  fmt::print("{} after {} iterations; the motion's gaps are closed to {:.1e}, and it repeats to {:.1e}.\n\n",
             done.status, done.iterations, done.gap, done.period_error);
  std::vector<std::vector<std::string>> rows;
  for (const auto& misfit : done.misfits) {
    rows.push_back({misfit.what, fmt::format("{:.3g}", misfit.rms)});
  }
  print_table({"curve", "rms difference"}, rows);
  rows.clear();
  th::Constants chosen = done.constants;
  for (const validation::FreeConstant& one : file.design.free) {
    rows.push_back({one.name, fmt::format("{:.6g}", *validation::constant_by_name(chosen, one.name)),
                    fmt::format("{:.6g}", one.believed), fmt::format("{:.3g}", one.tolerance)});
  }
  fmt::print("\n");
  print_table({"chosen", "value (SI)", "believed", "tolerance"}, rows);
  const validation::StrideFacts& f = done.facts;
  fmt::print("\nstance {:.4f} s, flight {:.4f} s, travel in flight {:.3f} m\n", f.stance, f.flight, f.travel);
  fmt::print("normal force from {:.1f} N, at lift-off {:.1f} N; friction used {:.3f}, at touchdown {:.3f}\n",
             f.least_normal, f.last_normal, f.most_friction, std::abs(f.impulse_ratio));
  fmt::print("torques up to {:.1f} and {:.1f} N m; the toe leaves at {:.3f} m/s\n", f.most_torque[0],
             f.most_torque[1], f.lift);
  const auto line = [](const char* what, const std::vector<double>& values) {
    fmt::print("{}", what);
    for (const double value : values) {
      fmt::print(" {:.3f}", value);
    }
    fmt::print("\n");
  };
  line("multipliers without the outer loop:", open);
  line("multipliers with it:               ", closed);
}

void design(const Options& options, Outcome& outcome) {
  check_writable(options.output);
  check_writable(options.json);
  check_not_an_input(options.output, {options.file, options.base});
  validation::RunningDesignFile file = validation::read_running_design(options.file);
  file.design.iterations = options.iterations;
  file.design.print_level = options.verbose ? 5 : 0;
  DesignedRunning done = validation::design_running(file.design);
  if (!done.found) {
    fmt::print("{} after {} iterations: nothing was designed. Largest gap {:.1e}.\n", done.status,
               done.iterations, done.gap);
    outcome.status = 1;
    return;
  }
  const validation::LinearReturn map = validation::linear_return(done.constants, done.gait);
  done.gait.gain = validation::outer_loop(map, file.weights);
  const std::vector<double> open = validation::multipliers(map.by_state);
  const std::vector<double> closed = validation::multipliers(map.by_state + map.by_beta * done.gait.gain);
  print(file, done, open, closed);
  if (!options.output.empty()) {
    validation::write_running(options.output, options.base, done, file);
    fmt::print("Written to {}.\n", options.output);
  }
  nlohmann::json json{{"status", done.status},    {"iterations", done.iterations},
                      {"gap", done.gap},          {"period_error", done.period_error},
                      {"multipliers_open", open}, {"multipliers", closed}};
  for (const auto& misfit : done.misfits) {
    json["misfits"][misfit.what] = misfit.rms;
  }
  th::Constants chosen = done.constants;
  for (const validation::FreeConstant& one : file.design.free) {
    json["chosen"][one.name] = *validation::constant_by_name(chosen, one.name);
  }
  write_json(json, options.json);
}

void climb(const Options& options, Outcome& outcome) {
  check_writable(options.json);
  const validation::RunningLadder ladder = validation::read_running_ladder(options.file);
  std::vector<std::vector<std::string>> rows;
  nlohmann::json json{{"title", ladder.title}, {"rungs", nlohmann::json::array()}};
  bool all = true;
  validation::climb(ladder, &stop_flag(), [&](const validation::RungResult& rung) {
    const std::string contraction =
        rung.contraction ? fmt::format("{:.3f}", *rung.contraction) : rung.no_contraction;
    rows.push_back({rung.name, fmt::format("{}{}", rung.steps, rung.fell ? "" : " (ended by us)"),
                    contraction, fmt::format("{:.4f}", rung.period), fmt::format("{:.3f}", rung.speed),
                    rung.end});
    json["rungs"].push_back(
        {{"name", rung.name},
         {"steps", rung.steps},
         {"fell", rung.fell},
         {"end", rung.end},
         {"period", rung.period},
         {"speed", rung.speed},
         {"contraction", rung.contraction ? nlohmann::json(*rung.contraction) : nlohmann::json()}});
    all = all && !rung.fell;
  });
  print_table({"model", "strides", "contraction", "last stride, s", "speed, m/s", "end"}, rows);
  write_json(json, options.json);
  outcome.status = all ? 0 : 1;
}

}  // namespace

void add_running(CLI::App& app, Outcome& outcome) {
  CLI::App* group = app.add_subcommand("running", "Running gaits of a monopod with a spring in its leg");
  group->require_subcommand(1);
  auto options = std::make_shared<Options>();
  CLI::App* command = group->add_subcommand(
      "design", "find a periodic motion near published curves, its multipliers and the outer loop's gains");
  command->add_option("file", options->file, "what is wanted")->required()->type_name("FILE");
  command->add_option("-o,--output", options->output, "controller's file to write")->type_name("FILE");
  command
      ->add_option("--base", options->base,
                   "controller's file that it stands on: library, wiring, period, torque limits")
      ->type_name("FILE");
  command->add_option("--iterations", options->iterations, "of the optimiser, at most")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_flag("--verbose", options->verbose, "show the optimiser's own lines");
  add_json_option(*command, options->json);
  command->footer(
      "Exit status 1 where no periodic motion was found.\n\nExample:\n  plumbline study running design "
      "robots/thumper/running_design.yaml --base robots/thumper/controllers/wiring.yaml -o running.yaml");
  command->callback([options, &outcome] {
    if (!options->output.empty() && options->base.empty()) {
      throw InputError({"", 0, "--output"}, "no --base", "--base FILE, on which the written file stands");
    }
    design(*options, outcome);
  });
  CLI::App* ladder = group->add_subcommand(
      "ladder", "the gait on one model after the other, from its design's to the whole robot");
  ladder->add_option("file", options->file, "scenario and rungs")->required()->type_name("FILE");
  add_json_option(*ladder, options->json);
  ladder->footer(
      "Exit status 1 where it falls on a rung.\n\nExample:\n  plumbline study running ladder "
      "robots/thumper/ladder.yaml");
  ladder->callback([options, &outcome] { climb(*options, outcome); });
}

}  // namespace plumbline::cli
