#include "validation/cli/simulate_scenario.h"

#include <fmt/core.h>

#include <algorithm>

#include "simulator/model/kinds.h"
#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "validation/cli/files.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/control/gait/gait_run.h"
#include "validation/identify/trial/write_trial.h"
#include "validation/identify/twin/recorded_run.h"

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

/// Duration of each cycle, and what each quantity of the scenario changes by.
validation::GaitView view_of(const run::LoadedScenario& loaded, const validation::Gait& gait) {
  validation::GaitView view;
  view.gait = gait;
  view.where = {loaded.scenario.file, 0, "quantities"};
  view.measures.emplace_back();
  for (const run::Quantity& quantity : loaded.scenario.quantities) {
    validation::Measure change;
    change.kind = validation::Measure::Kind::change;
    change.channels = {quantity.name};
    change.text = "change of " + quantity.name;
    view.measures.push_back(change);
  }
  return view;
}

nlohmann::json to_json(const validation::GaitView& view, const std::vector<validation::Cycle>& cycles) {
  nlohmann::json json = nlohmann::json::array();
  for (const validation::Cycle& cycle : cycles) {
    nlohmann::json one{{"begin", cycle.begin}, {"end", cycle.end}};
    for (std::size_t m = 1; m < view.measures.size(); ++m) {
      one["change"][view.measures[m].channels.front()] = cycle.values[m];
    }
    json.push_back(one);
  }
  return json;
}

void print_cycles(const validation::GaitView& view, const std::vector<validation::Cycle>& cycles) {
  std::vector<std::string> head{to_string(view.gait.cycle), "end s", "duration s"};
  for (std::size_t m = 1; m < view.measures.size(); ++m) {
    head.push_back(view.measures[m].text);
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    std::vector<std::string> row{fmt::format("{}", c + 1), fmt::format("{:.3f}", cycles[c].end)};
    for (const double value : cycles[c].values) {
      row.push_back(fmt::format("{:.3f}", value));
    }
    rows.push_back(row);
  }
  fmt::print("\n");
  print_table(head, rows);
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

namespace {

validation::GaitOptions gait_options(const ScenarioOptions& options, long enough) {
  validation::GaitOptions gait;
  gait.enough = enough;
  gait.run = options_of(options);
  gait.stop = &stop_flag();
  return gait;
}

void simulate_starts(const ScenarioOptions& options, const run::LoadedScenario& loaded,
                     const validation::Gait& gait) {
  if (!options.out.empty() || !options.record.empty()) {
    throw InputError({"", 0, options.out.empty() ? "--record" : "--out"}, "more than one start",
                     "a single run for a trace or a trial");
  }
  const validation::GaitView view = view_of(loaded, gait);
  ProgressLine line;
  const validation::Progress show = line.callback();
  const std::vector<validation::GaitRun> runs =
      validation::run_gaits(validation::from_starts(loaded, options.starts, options.seed), view,
                            gait_options(options, options.cycles > 0 ? options.cycles : options.enough),
                            [&](int done) { show("runs", static_cast<double>(done) / options.starts); });
  const validation::Share share = validation::share_of("random starts", runs, options.enough);
  nlohmann::json json{{"scenario", options.scenario},
                      {"starts", share.runs},
                      {"sustained", share.sustained},
                      {"median_cycles", share.median_cycles},
                      {"runs", nlohmann::json::array()}};
  for (const validation::GaitRun& run : runs) {
    json["runs"].push_back({{"cycles", run.cycles.size()}, {"time", run.run.time}, {"end", run.run.end}});
  }
  write_json(json, options.json);
  fmt::print("{} of {} starts sustained ({} cycles or more); median {:.0f}.\n\n", share.sustained, share.runs,
             options.enough, share.median_cycles);
  const auto settled = validation::settled_cycles(gait, runs);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t m = 0; m < view.measures.size(); ++m) {
    const validation::Spread spread = validation::spread_of(validation::values_of(settled, m));
    rows.push_back({m == 0 ? "duration" : view.measures[m].text,
                    fmt::format("{:.4g} +- {:.2g}", spread.mean, spread.deviation)});
  }
  print_table({"over the settled cycles, SI", "mean"}, rows);
}

}  // namespace

void simulate_scenario(const ScenarioOptions& options) {
  check_new_folder(options.record);
  check_not_an_input(options.out, {options.scenario, options.model, options.controller});
  const run::LoadedScenario loaded = load_scenario(options);
  const auto gait = validation::read_gait(loaded);
  if (!gait && (options.cycles > 0 || options.starts > 1)) {
    throw InputError({"", 0, options.cycles > 0 ? "--cycles" : "--starts"},
                     "a scenario without a section gait", "one that says what its cycles are");
  }
  if (options.starts > 1) {
    simulate_starts(options, loaded, *gait);
    return;
  }
  const validation::GaitView view = gait ? view_of(loaded, *gait) : validation::GaitView();
  validation::GaitRun done;
  if (gait) {
    done = validation::run_gait(loaded, view, gait_options(options, options.cycles));
  } else {
    done.run = run::run_scenario(loaded.model, loaded.scenario,
                                 loaded.controller ? &*loaded.controller : nullptr, options_of(options));
  }
  const run::RunRecord& run = done.run;
  nlohmann::json json = to_json(run, loaded, options);
  json["cycles"] = to_json(view, done.cycles);
  if (!options.out.empty()) {
    write_trace(run.trace, options.out);
    json["trace"] = options.out;
  }
  if (!options.record.empty()) {
    validation::Trial trial = validation::recorded_run(loaded.model, run.record, loaded.scenario);
    trial.role = options.role;
    validation::write_trial(trial, loaded.model, options.record);
    json["trial"] = options.record;
  }
  write_json(json, options.json);
  print(run, loaded);
  if (!done.cycles.empty()) {
    print_cycles(view, done.cycles);
  }
}

}  // namespace plumbline::cli
