#include <fmt/core.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/inverse_model/inverse_model.h"
#include "validation/replay/replay.h"

namespace plumbline::cli {
namespace {

using validation::Replay;

struct Options {
  std::string trial, experiment, model, data_folder, out, json;
  validation::ReplayOptions replay;
};

Replay replay_trial(const Options& options, std::string& model_file) {
  model_file = options.model.empty() ? validation::model_of_trial(options.trial) : options.model;
  const model::Model model = model::read_model(model_file, model::known_effects());
  const validation::Trial trial = validation::read_trial(options.trial, model, {options.data_folder});
  validation::check_command_units(model, trial);
  check_not_an_input(options.out, {trial.data_file});
  return validation::replay(model, trial, options.replay);
}

Replay replay_experiment(const Options& options) {
  const model::Model model = model::read_model(options.model, model::known_effects());
  return validation::replay(model, validation::read_experiment(options.experiment, model), options.replay);
}

double relative(double error, double exchanged) { return exchanged > 0.0 ? error / exchanged : 0.0; }

nlohmann::json to_json(const Replay& replay, const Options& options, const std::string& model) {
  const integrate::Summary& summary = replay.run.summary;
  nlohmann::json json{{"model", model},
                      {"closed_loop", options.replay.closed_loop},
                      {"samples", replay.run.time.size()},
                      {"duration", replay.duration}};
  json[options.trial.empty() ? "experiment" : "trial"] =
      options.trial.empty() ? options.experiment : options.trial;
  json["summary"] = {{"method", summary.method},
                     {"relative_tolerance", options.replay.integrator.relative_tolerance},
                     {"steps", summary.steps},
                     {"error_test_failures", summary.error_test_failures},
                     {"rate_evaluations", summary.rate_evaluations},
                     {"jacobian_evaluations", summary.jacobian_evaluations},
                     {"roots", summary.switches_found},
                     {"restarts", summary.restarts},
                     {"wall_time_per_simulated_second", replay.seconds / replay.duration}};
  json["energy"] = {{"error", replay.run.energy_error},
                    {"exchanged", replay.run.energy_exchanged},
                    {"relative_error", relative(replay.run.energy_error, replay.run.energy_exchanged)}};
  json["channels"] = nlohmann::json::array();
  for (const validation::ReplayError& error : replay.errors) {
    json["channels"].push_back(
        {{"name", error.sensor}, {"unit", error.unit}, {"rms", error.rms}, {"floor", error.floor}});
  }
  if (!options.out.empty()) {
    json["trace"] = options.out;
  }
  return json;
}

void print(const Replay& replay, const Options& options) {
  const integrate::Summary& summary = replay.run.summary;
  fmt::print("Simulated {:g} s with {}, relative tolerance {:g}:\n\n", replay.duration, summary.method,
             options.replay.integrator.relative_tolerance);
  print_table(
      {"summary", ""},
      {{"integrator steps",
        fmt::format("{} ({} more failed the error test)", summary.steps, summary.error_test_failures)},
       {"rate evaluations", fmt::format("{}", summary.rate_evaluations)},
       {"Jacobian evaluations", fmt::format("{}", summary.jacobian_evaluations)},
       {"roots of switching functions", fmt::format("{}", summary.switches_found)},
       {"restarts", fmt::format("{}", summary.restarts)},
       {"energy balance",
        fmt::format("off by {:.2e} J, {:.1e} of the {:.4g} J exchanged", replay.run.energy_error,
                    relative(replay.run.energy_error, replay.run.energy_exchanged),
                    replay.run.energy_exchanged)},
       {"wall time per simulated second", fmt::format("{:.3g} s", replay.seconds / replay.duration)}});
  if (!replay.errors.empty()) {
    fmt::print("\nMeasured minus simulated, in one piece from the start ({}):\n\n",
               options.replay.closed_loop ? "closed loop" : "recorded commands");
    std::vector<std::vector<std::string>> rows;
    for (const validation::ReplayError& error : replay.errors) {
      rows.push_back({error.sensor, fmt::format("{:.4g} {}", error.rms, error.unit),
                      fmt::format("{:.3g} {}", error.floor, error.unit)});
    }
    print_table({"channel", "rms", "floor"}, rows);
  }
  if (!options.out.empty()) {
    fmt::print("\nTrace: {}\n", options.out);
  }
}

void check_choice(const Options& options) {
  if (options.trial.empty() == options.experiment.empty()) {
    throw InputError({"", 0, "simulate"},
                     options.trial.empty() ? "neither TRIAL nor --experiment" : "both TRIAL and --experiment",
                     "one of them");
  }
  if (!options.experiment.empty() && options.model.empty()) {
    throw InputError({"", 0, "--experiment"}, "no --model", "the model that the experiment is run on");
  }
  if (!options.experiment.empty() && options.replay.closed_loop) {
    throw InputError({"", 0, "--closed-loop"}, "an experiment", "a trial that names its controller");
  }
}

void run(Options options) {
  check_choice(options);
  check_trace_file(options.out);
  check_writable(options.json);
  check_not_an_input(options.out, {options.model, options.experiment});
  integrate::Options& integrator = options.replay.integrator;
  integrator.set_tolerance(integrator.relative_tolerance);
  integrator.validate();
  options.replay.stop = &stop_flag();
  std::string model = options.model;
  const Replay replay = options.trial.empty() ? replay_experiment(options) : replay_trial(options, model);
  if (!options.out.empty()) {
    write_trace(replay.trace, options.out);
  }
  write_json(to_json(replay, options, model), options.json);
  print(replay, options);
}

void add_method(CLI::App& command, integrate::Options& options) {
  const std::map<std::string, integrate::Method> methods{{"explicit_rk", integrate::Method::explicit_rk},
                                                         {"implicit_rk", integrate::Method::implicit_rk},
                                                         {"rosenbrock", integrate::Method::rosenbrock},
                                                         {"bdf", integrate::Method::bdf}};
  command
      .add_option_function<std::string>(
          "--method", [&options, methods](const std::string& name) { options.method = methods.at(name); },
          "explicit_rk, or for stiff models rosenbrock, implicit_rk or bdf")
      ->default_str("explicit_rk")
      ->check(CLI::IsMember(methods))
      ->type_name("METHOD");
  command.add_option("--tolerance", options.relative_tolerance, "relative tolerance of the integrator")
      ->capture_default_str()
      ->check(between(1e-13, 1e-1))
      ->type_name("NUMBER");
}

}  // namespace

void add_simulate(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  options->replay.integrator.relative_tolerance = 1e-8;
  CLI::App* command = app.add_subcommand("simulate", "Run a trial or an experiment on a model, in one piece");
  command->add_option("trial", options->trial, "trial folder (or its trial.yaml)")->type_name("TRIAL");
  command
      ->add_option("--experiment", options->experiment, "experiment file in place of a trial; needs --model")
      ->type_name("FILE");
  command->add_option("--model", options->model, "model file in place of the one the trial names")
      ->type_name("FILE");
  command->add_option("--data", options->data_folder, "folder with the trial's data files")->type_name("DIR");
  command->add_option("-o,--out", options->out, "write the trace to FILE (.csv or .mat)")->type_name("FILE");
  command->add_flag("--closed-loop", options->replay.closed_loop,
                    "let the trial's controllers command the motors, not the recording");
  add_method(*command, options->replay.integrator);
  add_json_option(*command, options->json);
  command->footer(
      "Example:\n  plumbline simulate demo/siso_mLA --model robots/mabel/leg_bench.yaml -o trace.csv");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
