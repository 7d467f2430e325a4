#include "validation/cli/simulate_scenario.h"

#include <fmt/core.h>

#include <algorithm>

#include "simulator/model/kinds.h"
#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "validation/cli/files.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/trial/write_trial.h"
#include "validation/twin/recorded_run.h"

namespace plumbline::cli {
namespace {

run::RunOptions options_of(const ScenarioOptions& options) {
  run::RunOptions run;
  if (options.tolerance > 0.0) {
    run.integrator.set_tolerance(options.tolerance);
  }
  if (options.method) {
    run.integrator.method = *options.method;
  }
  run.integrator.validate();
  run.energy = options.energy;
  run.sensors.seed = options.seed;
  run.trace = !options.out.empty() || !options.record.empty();
  run.watch = [](const run::SampledRun&) {
    if (stop_flag().raised) {
      throw validation::Stopped();
    }
    return false;
  };
  return run;
}

nlohmann::json to_json(const run::RunRecord& run, const run::LoadedScenario& loaded,
                       const ScenarioOptions& options) {
  nlohmann::json json{{"scenario", options.scenario},
                      {"model", loaded.scenario.model},
                      {"duration", run.time},
                      {"fell", run.fell},
                      {"end", run.end},
                      {"summary",
                       {{"method", run.summary.method},
                        {"steps", run.summary.steps},
                        {"rate_evaluations", run.summary.rate_evaluations},
                        {"wall_time_per_simulated_second", run.time > 0.0 ? run.seconds / run.time : 0.0}}},
                      {"energy", nullptr}};
  if (options.energy) {
    json["energy"] = {{"error", run.energy_error}, {"exchanged", run.energy_exchanged}};
  }
  if (loaded.controller) {
    const run::ControllerSetup& setup = *loaded.controller;
    json["controller"] = {{"file", setup.file},
                          {"name", setup.library.api().name},
                          {"version", setup.library.api().version},
                          {"library", setup.library.path()},
                          {"sha256", setup.library.sha256()},
                          {"fault", run.fault}};
  }
  return json;
}

void print(const run::RunRecord& run, const run::LoadedScenario& loaded) {
  fmt::print("{}: {:.3f} s{}{}.\n\n", loaded.scenario.title, run.time,
             run.end.empty() ? "" : ", then: ", run.end);
  std::vector<std::vector<std::string>> rows{
      {"model", loaded.model.file},
      {"integrator", fmt::format("{}, {} steps", run.summary.method, run.summary.steps)},
      {"wall time per simulated second",
       fmt::format("{:.3g} s", run.time > 0.0 ? run.seconds / run.time : 0.0)}};
  if (loaded.controller) {
    const run::ControllerSetup& setup = *loaded.controller;
    rows.insert(rows.begin() + 1, {"controller", fmt::format("{}, version {}, {}", setup.library.api().name,
                                                             setup.library.api().version, setup.file)});
    rows.insert(rows.begin() + 2, {"SHA-256 of its library", setup.library.sha256()});
  }
  if (run.energy_exchanged > 0.0) {
    rows.push_back({"energy balance", fmt::format("off by {:.2e} J of the {:.4g} J exchanged",
                                                  run.energy_error, run.energy_exchanged)});
  }
  print_table({"run", ""}, rows);
}

}  // namespace

namespace {

/// NAME=VALUE.
std::pair<std::string, double> assignment(const std::string& text, const char* option, const char* expected) {
  const std::size_t equal = text.find('=');
  const auto value = equal == std::string::npos ? std::nullopt : parse_number(text.substr(equal + 1));
  if (!value) {
    throw InputError({"", 0, option}, "\"" + text + "\"", expected);
  }
  return {text.substr(0, equal), *value};
}

/// A position or velocity of the start, named itself or by a quantity of the scenario.
void set_named(run::LoadedScenario& loaded, std::vector<run::Named>& list, std::string name, double value) {
  for (const run::Quantity& quantity : loaded.scenario.quantities) {
    if (quantity.name == name) {
      name = quantity.of;
      value /= quantity.times;
      break;
    }
  }
  std::vector<std::string> known = model::position_names(loaded.model);
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw InputError({"", 0, "--start"}, "\"" + name + "\"",
                     "a coordinate, motor or quantity" + nearest_names(name, known));
  }
  for (auto& [one, number] : list) {
    if (one == name) {
      number = value;
      return;
    }
  }
  list.emplace_back(name, value);
}

void set_start(run::LoadedScenario& loaded, const std::string& text) {
  constexpr const char* kExpected = "clearance=VALUE, position:NAME=VALUE or velocity:NAME=VALUE, in SI";
  const auto [name, value] = assignment(text, "--start", kExpected);
  run::Start& start = loaded.scenario.start;
  if (name == "clearance" && !start.height.empty()) {
    start.clearance = value;
  } else if (name.rfind("position:", 0) == 0) {
    set_named(loaded, start.positions, name.substr(9), value);
  } else if (name.rfind("velocity:", 0) == 0) {
    set_named(loaded, start.velocities, name.substr(9), value);
  } else {
    throw InputError({"", 0, "--start"}, "\"" + text + "\"", kExpected);
  }
}

}  // namespace

void set_constant(run::ControllerSetup& setup, const std::string& text) {
  const auto [name, value] = assignment(text, "--set", "CONSTANT=VALUE, the value in SI");
  setup.set(name, value);
}

run::LoadedScenario load_scenario(const ScenarioOptions& options) {
  run::LoadedScenario loaded = run::read_scenario(options.scenario, {options.model, options.controller});
  if (!options.set.empty() && !loaded.controller) {
    throw InputError({"", 0, "--set"}, "a scenario without a controller", "one whose constants can be set");
  }
  for (const std::string& text : options.set) {
    set_constant(*loaded.controller, text);
  }
  for (const std::string& text : options.start) {
    set_start(loaded, text);
  }
  if (!options.platforms.empty()) {
    loaded.scenario.terrain = terrain_of(options.platforms);
  }
  if (options.seconds > 0.0) {
    loaded.scenario.longest = options.seconds;
  }
  return loaded;
}

void simulate_scenario(const ScenarioOptions& options) {
  check_new_folder(options.record);
  check_not_an_input(options.out, {options.scenario, options.model, options.controller});
  const run::LoadedScenario loaded = load_scenario(options);
  const run::RunRecord run = run::run_scenario(
      loaded.model, loaded.scenario, loaded.controller ? &*loaded.controller : nullptr, options_of(options));
  nlohmann::json json = to_json(run, loaded, options);
  if (!options.out.empty()) {
    write_trace(run.trace, options.out);
    json["trace"] = options.out;
  }
  if (!options.record.empty()) {
    validation::Trial trial = validation::recorded_run(loaded.model, run.record, loaded.scenario.title);
    trial.role = options.role;
    validation::write_trial(trial, loaded.model, options.record);
    json["trial"] = options.record;
  }
  write_json(json, options.json);
  print(run, loaded);
}

}  // namespace plumbline::cli
