#include <fmt/core.h>

#include "simulator/model/engine.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/simulate_scenario.h"
#include "validation/identify/inverse_model/inverse_model.h"
#include "validation/identify/replay/replay.h"

namespace plumbline::cli {
namespace {

using validation::Replay;

struct Options {
  std::string trial, experiment, model, data_folder, out, json;
  validation::ReplayOptions replay;
  ScenarioOptions scenario;
  model::Engine engine = model::Engine::tree;
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
  add(options.scenario.scenario, "--scenario");
  return names;
}

void check_choice(const Options& options) {
  const std::string names = chosen(options);
  if (names.empty() || names.find(' ') != std::string::npos) {
    throw InputError({"", 0, "simulate"}, names.empty() ? "nothing" : names,
                     "one of TRIAL, --experiment and --scenario");
  }
  if (!options.experiment.empty() && options.model.empty()) {
    throw InputError({"", 0, names}, "no --model", "the model that is simulated");
  }
  if (options.trial.empty() && options.replay.closed_loop) {
    throw InputError({"", 0, "--closed-loop"}, names, "a trial that names its controller");
  }
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
  model::set_engine(options.engine);
  check_trace_file(options.out);
  check_writable(options.json);
  check_not_an_input(options.out, {options.model, options.experiment});
  if (options.scenario.scenario.empty()) {
    run_replay(options);
  } else {
    ScenarioOptions scenario = options.scenario;
    scenario.model = options.model;
    scenario.out = options.out;
    scenario.json = options.json;
    simulate_scenario(scenario);
  }
  if (!options.out.empty()) {
    fmt::print("\nTrace: {}\n", options.out);
  }
}

void add_engine(CLI::App& command, Options& options) {
  const std::map<std::string, model::Engine> engines{{"tree", model::Engine::tree},
                                                     {"simbody", model::Engine::simbody}};
  command
      .add_option_function<std::string>(
          "--engine", [&options, engines](const std::string& name) { options.engine = engines.at(name); },
          "what computes the rigid bodies' mass matrix and bias: the project's own tree, or simbody for "
          "Simbody's operators (slower)")
      ->check(CLI::IsMember(engines))
      ->type_name("ENGINE");
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
            options.scenario.method = options.replay.integrator.method = methods.at(name);
          },
          "explicit_rk, or for stiff models rosenbrock (as it is with --scenario), implicit_rk or bdf")
      ->check(CLI::IsMember(methods))
      ->type_name("METHOD");
  command
      .add_option_function<double>(
          "--tolerance",
          [&options](double tolerance) {
            options.replay.integrator.set_tolerance(tolerance);
            options.scenario.tolerance = tolerance;
          },
          "relative tolerance of the integrator: 1e-8, with --scenario 1e-5")
      ->check(between(1e-13, 1e-1))
      ->type_name("NUMBER");
}

void add_scenario_options(CLI::App& command, ScenarioOptions& options) {
  command
      .add_option("--scenario", options.scenario,
                  "in place of a trial: a robot under its controller, as this file states it")
      ->type_name("FILE");
  const auto needs_scenario = [](CLI::Option* option) { return option->needs("--scenario"); };
  needs_scenario(command.add_option("--controller", options.controller,
                                    "with --scenario: another controller's file than the scenario names"))
      ->type_name("FILE");
  needs_scenario(
      command.add_option("--set", options.set, "with --scenario: a constant of the controller, SI"))
      ->type_name("CONSTANT=VALUE");
  needs_scenario(command.add_option("--start", options.start,
                                    "with --scenario: another start, SI: clearance=0.06, "
                                    "velocity:travel=-0.45, position:torso=0.1"))
      ->type_name("WHAT=VALUE");
  needs_scenario(
      command.add_option("--seconds", options.seconds, "with --scenario: end after so many seconds"))
      ->check(CLI::PositiveNumber);
  needs_scenario(command.add_option("--cycles", options.cycles,
                                    "with --scenario: end after so many steps, hops or strides of its gait"))
      ->check(CLI::PositiveNumber);
  needs_scenario(command.add_option("--starts", options.starts,
                                    "with --scenario: so many random starts, drawn from its ranges"))
      ->check(CLI::PositiveNumber);
  needs_scenario(
      command.add_option("--enough", options.enough, "with --starts: cycles that count as sustained"))
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  needs_scenario(
      command.add_option("--platform", options.platforms,
                         "with --scenario: a step in the ground, in place of the scenario's terrain: "
                         "from and to along the way, height, m (again for more)"))
      ->type_name("FROM TO HEIGHT");
  needs_scenario(command.add_option("--seed", options.seed, "with --scenario: seed of the sensors' noise"))
      ->capture_default_str();
  needs_scenario(
      command.add_flag("--energy", options.energy,
                       "with --scenario: integrate work and dissipation too, and say whether the energy "
                       "adds up; the steps are then a little different"));
  CLI::Option* record = command.add_option(
      "--record", options.record,
      "with --scenario: write the run to the folder DIR as a trial, as the robot's sensors recorded it");
  needs_scenario(record)->type_name("DIR");
  command.add_option("--role", options.role, "of that trial: train or held-out")
      ->needs(record)
      ->transform(CLI::CheckedTransformer(std::map<std::string, validation::Role>{
          {"train", validation::Role::train}, {"held-out", validation::Role::held_out}}))
      ->type_name("ROLE");
}

}  // namespace

void add_simulate(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  options->replay.integrator.set_tolerance(1e-8);
  CLI::App* command = app.add_subcommand(
      "simulate", "Run a trial, an experiment or a scenario (a robot under its controller), in one piece");
  command->add_option("trial", options->trial, "trial folder (or its trial.yaml)")->type_name("TRIAL");
  command
      ->add_option("--experiment", options->experiment, "experiment file in place of a trial; needs --model")
      ->type_name("FILE");
  add_scenario_options(*command, options->scenario);
  command->add_option("--model", options->model, "model file in place of the one the trial names")
      ->type_name("FILE");
  command->add_option("--data", options->data_folder, "folder with the trial's data files")->type_name("DIR");
  command->add_option("-o,--out", options->out, "write the trace to FILE (.csv or .mat)")->type_name("FILE");
  command->add_flag("--closed-loop", options->replay.closed_loop,
                    "let the trial's controllers command the motors, not the recording");
  add_method(*command, *options);
  add_engine(*command, *options);
  add_json_option(*command, options->json);
  command->footer(
      "Example:\n  plumbline simulate demo/siso_mLA --model robots/mabel/leg_bench.yaml -o trace.csv\n"
      "  plumbline simulate --scenario robots/mabel/scenarios/hopping_boom.yaml -o hops.csv");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
