#include <fmt/core.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/hop_report.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/hopping/hop_run.h"
#include "validation/hopping/hopping_file.h"
#include "validation/inverse_model/inverse_model.h"
#include "validation/replay/replay.h"

namespace plumbline::cli {
namespace {

using validation::Replay;

struct Options {
  std::string trial, experiment, controller, model, data_folder, out, json;
  validation::ReplayOptions replay;
  validation::HopOptions hop;
};

/// What is said of every simulation.
struct Course {
  const integrate::Summary& summary;
  double relative_tolerance, duration, seconds, energy_error, energy_exchanged;

  double energy_share() const { return energy_exchanged > 0.0 ? energy_error / energy_exchanged : 0.0; }
  double seconds_per_second() const { return duration > 0.0 ? seconds / duration : 0.0; }
};

Course course_of(const Replay& replay, const Options& options) {
  return {replay.run.summary,      options.replay.integrator.relative_tolerance,
          replay.duration,         replay.seconds,
          replay.run.energy_error, replay.run.energy_exchanged};
}

Course course_of(const validation::HopRun& run, const Options& options) {
  return {run.summary,      options.hop.integrator.relative_tolerance,
          run.time,         run.seconds,
          run.energy_error, run.energy_exchanged};
}

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

nlohmann::json to_json(const Course& course) {
  const integrate::Summary& summary = course.summary;
  return {{"duration", course.duration},
          {"summary",
           {{"method", summary.method},
            {"relative_tolerance", course.relative_tolerance},
            {"steps", summary.steps},
            {"error_test_failures", summary.error_test_failures},
            {"rate_evaluations", summary.rate_evaluations},
            {"jacobian_evaluations", summary.jacobian_evaluations},
            {"roots", summary.switches_found},
            {"restarts", summary.restarts},
            {"wall_time_per_simulated_second", course.seconds_per_second()}}},
          {"energy",
           {{"error", course.energy_error},
            {"exchanged", course.energy_exchanged},
            {"relative_error", course.energy_share()}}}};
}

nlohmann::json to_json(const Replay& replay, const Options& options, const std::string& model) {
  nlohmann::json json = to_json(course_of(replay, options));
  json["model"] = model;
  json["closed_loop"] = options.replay.closed_loop;
  json["samples"] = replay.run.time.size();
  json[options.trial.empty() ? "experiment" : "trial"] =
      options.trial.empty() ? options.experiment : options.trial;
  json["channels"] = nlohmann::json::array();
  for (const validation::ReplayError& error : replay.errors) {
    json["channels"].push_back(
        {{"name", error.sensor}, {"unit", error.unit}, {"rms", error.rms}, {"floor", error.floor}});
  }
  return json;
}

nlohmann::json to_json(const validation::HopRun& run, const Options& options) {
  nlohmann::json json = to_json(course_of(run, options));
  json["model"] = options.model;
  json["controller"] = options.controller;
  json["hops"] = hops_json(run);
  json["fell"] = run.fell;
  json["end"] = run.end;
  return json;
}

void print(const Course& course) {
  const integrate::Summary& summary = course.summary;
  fmt::print("Simulated {:g} s with {}, relative tolerance {:g}:\n\n", course.duration, summary.method,
             course.relative_tolerance);
  print_table(
      {"summary", ""},
      {{"integrator steps",
        fmt::format("{} ({} more failed the error test)", summary.steps, summary.error_test_failures)},
       {"rate evaluations", fmt::format("{}", summary.rate_evaluations)},
       {"Jacobian evaluations", fmt::format("{}", summary.jacobian_evaluations)},
       {"roots of switching functions", fmt::format("{}", summary.switches_found)},
       {"restarts", fmt::format("{}", summary.restarts)},
       {"energy balance", fmt::format("off by {:.2e} J, {:.1e} of the {:.4g} J exchanged",
                                      course.energy_error, course.energy_share(), course.energy_exchanged)},
       {"wall time per simulated second", fmt::format("{:.3g} s", course.seconds_per_second())}});
}

void print_errors(const Replay& replay, bool closed_loop) {
  if (replay.errors.empty()) {
    return;
  }
  fmt::print("\nMeasured minus simulated, in one piece from the start ({}):\n\n",
             closed_loop ? "closed loop" : "recorded commands");
  std::vector<std::vector<std::string>> rows;
  for (const validation::ReplayError& error : replay.errors) {
    rows.push_back({error.sensor, fmt::format("{:.4g} {}", error.rms, error.unit),
                    fmt::format("{:.3g} {}", error.floor, error.unit)});
  }
  print_table({"channel", "rms", "floor"}, rows);
}

/// The trace and the JSON, where asked for.
void write_files(nlohmann::json json, const Table& trace, const Options& options) {
  if (!options.out.empty()) {
    write_trace(trace, options.out);
    json["trace"] = options.out;
  }
  write_json(json, options.json);
}

std::string chosen(const Options& options) {
  std::string names;
  const auto add = [&](const std::string& given, const char* name) {
    if (!given.empty()) {
      names += (names.empty() ? "" : " and ") + std::string(name);
    }
  };
  add(options.trial, "TRIAL");
  add(options.experiment, "--experiment");
  add(options.controller, "--controller");
  return names;
}

void check_choice(const Options& options) {
  const std::string names = chosen(options);
  if (names.empty() || names.find(' ') != std::string::npos) {
    throw InputError({"", 0, "simulate"}, names.empty() ? "nothing" : names,
                     "one of TRIAL, --experiment and --controller");
  }
  if (options.trial.empty() && options.model.empty()) {
    throw InputError({"", 0, names}, "no --model", "the model that is simulated");
  }
  if (options.trial.empty() && options.replay.closed_loop) {
    throw InputError({"", 0, "--closed-loop"}, names, "a trial that names its controller");
  }
}

void run_hops(Options options) {
  validation::HopOptions& hop = options.hop;
  hop.energy = true;
  hop.trace = !options.out.empty();
  hop.stop = &stop_flag();
  hop.integrator.validate();
  const model::Model model = model::read_model(options.model, model::known_effects());
  const validation::HopRun run =
      validation::hop(model, validation::read_hopping(options.controller), validation::HopStart(), hop);
  write_files(to_json(run, options), run.trace, options);
  print(course_of(run, options));
  fmt::print("\n");
  print_hops(run);
}

void run_replay(Options options) {
  options.replay.integrator.validate();
  options.replay.stop = &stop_flag();
  std::string model = options.model;
  const Replay replay = options.trial.empty() ? replay_experiment(options) : replay_trial(options, model);
  write_files(to_json(replay, options, model), replay.trace, options);
  print(course_of(replay, options));
  print_errors(replay, options.replay.closed_loop);
}

void run(const Options& options) {
  check_choice(options);
  check_trace_file(options.out);
  check_writable(options.json);
  check_not_an_input(options.out, {options.model, options.experiment, options.controller});
  options.controller.empty() ? run_replay(options) : run_hops(options);
  if (!options.out.empty()) {
    fmt::print("\nTrace: {}\n", options.out);
  }
}

void add_method(CLI::App& command, Options& options) {
  const std::map<std::string, integrate::Method> methods{{"explicit_rk", integrate::Method::explicit_rk},
                                                         {"implicit_rk", integrate::Method::implicit_rk},
                                                         {"rosenbrock", integrate::Method::rosenbrock},
                                                         {"bdf", integrate::Method::bdf}};
  command
      .add_option_function<std::string>(
          "--method",
          [&options, methods](const std::string& name) {
            options.replay.integrator.method = options.hop.integrator.method = methods.at(name);
          },
          "explicit_rk, or for stiff models rosenbrock (as it is with --controller), implicit_rk or bdf")
      ->check(CLI::IsMember(methods))
      ->type_name("METHOD");
  command
      .add_option_function<double>(
          "--tolerance",
          [&options](double tolerance) {
            options.replay.integrator.set_tolerance(tolerance);
            options.hop.integrator.set_tolerance(tolerance);
          },
          "relative tolerance of the integrator: 1e-8, with --controller 1e-5")
      ->check(between(1e-13, 1e-1))
      ->type_name("NUMBER");
}

}  // namespace

void add_simulate(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  options->replay.integrator.set_tolerance(1e-8);
  CLI::App* command =
      app.add_subcommand("simulate", "Run a trial, an experiment or a controller on a model, in one piece");
  command->add_option("trial", options->trial, "trial folder (or its trial.yaml)")->type_name("TRIAL");
  command
      ->add_option("--experiment", options->experiment, "experiment file in place of a trial; needs --model")
      ->type_name("FILE");
  command
      ->add_option("--controller", options->controller,
                   "in place of a trial let the robot hop under this controller; needs --model")
      ->type_name("FILE");
  command->add_option("--hops", options->hop.hops, "with --controller: end after so many hops")
      ->capture_default_str()
      ->check(CLI::PositiveNumber)
      ->needs("--controller");
  command->add_option("--model", options->model, "model file in place of the one the trial names")
      ->type_name("FILE");
  command->add_option("--data", options->data_folder, "folder with the trial's data files")->type_name("DIR");
  command->add_option("-o,--out", options->out, "write the trace to FILE (.csv or .mat)")->type_name("FILE");
  command->add_flag("--closed-loop", options->replay.closed_loop,
                    "let the trial's controllers command the motors, not the recording");
  add_method(*command, *options);
  add_json_option(*command, options->json);
  command->footer(
      "Example:\n  plumbline simulate demo/siso_mLA --model robots/mabel/leg_bench.yaml -o trace.csv\n"
      "  plumbline simulate --model robots/mabel/mabel.yaml --controller robots/mabel/hopping_boom.yaml "
      "--hops 10");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
