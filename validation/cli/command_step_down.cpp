// A walking robot steps down: outcomes and contact intensities beside what was published.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "simulator/trace/error.h"
#include "validation/cli/command_walking.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/ranks.h"
#include "validation/studies/step_down/step_down.h"

namespace plumbline::cli {
namespace {

using validation::PublishedStepDown;
using validation::Spread;
using validation::StepDownRun;
using validation::StepDownShare;
using validation::StepDownTest;
using validation::Touchdown;
using Ended = StepDownRun::Outcome;

struct StepDownArguments {
  std::string file, json;
  std::string controller;
  std::vector<double> heights;  // cm
  validation::StepDownOptions options;
};

const PublishedStepDown* published_of(const StepDownTest& test, double height) {
  for (const PublishedStepDown& one : test.published) {
    if (std::abs(one.height - height) < 1e-6) {
      return &one;
    }
  }
  return nullptr;
}

/// Over the runs that have an n-th touchdown on the lower ground.
template <typename Number>
Spread over_runs(const StepDownShare& cell, int n, const Number& number) {
  std::vector<double> values;
  for (const StepDownRun& run : cell.runs) {
    if (const Touchdown* touchdown = run.behind_edge(n)) {
      values.push_back(number(*touchdown));
    }
  }
  return validation::spread_of(values);
}

std::string text(const Spread& spread) {
  if (spread.count == 0) {
    return "-";
  }
  return spread.count == 1 ? fmt::format("{:.1f}", spread.mean)
                           : fmt::format("{:.1f} +- {:.1f}", spread.mean, spread.deviation);
}

std::string text(const std::optional<double>& number) {
  return number ? fmt::format("{:.1f}", *number) : "-";
}

double vertical(const Touchdown& one) { return one.impulse.z(); }
double by_force(const Touchdown& one) { return one.force_impulse; }

/// The step down itself falls: of all starts, how many of each outcome.
std::string outcome_text(const StepDownShare& cell) {
  const auto runs = static_cast<int>(cell.runs.size());
  if (runs == 1) {
    const StepDownRun& run = cell.runs.front();
    return run.outcome == Ended::passed  ? "passed"
           : run.outcome == Ended::broke ? "fuse breaks"
           : run.outcome == Ended::fell  ? "falls"
                                         : "edge not reached";
  }
  return fmt::format("{} of {} pass, {} break, {} fall", cell.count(Ended::passed), runs,
                     cell.count(Ended::broke), cell.count(Ended::fell));
}

void print_controller(const StepDownTest& test, const std::vector<StepDownShare>& cells,
                      const std::string& controller) {
  std::vector<std::vector<std::string>> rows;
  for (const StepDownShare& cell : cells) {
    if (cell.controller != controller) {
      continue;
    }
    const PublishedStepDown* published = cell.height > 0.0 ? published_of(test, cell.height) : nullptr;
    rows.push_back({fmt::format("{:.2f} ({:.1f} inch)", 100.0 * cell.height, cell.height / 0.0254),
                    outcome_text(cell),
                    published == nullptr ? "-"
                    : published->passed  ? "passed"
                                         : "broke",
                    text(over_runs(cell, 1, vertical)), published == nullptr ? "-" : text(published->first),
                    text(over_runs(cell, 2, vertical)), published == nullptr ? "-" : text(published->second),
                    text(over_runs(cell, 1, by_force)), text(over_runs(cell, 2, by_force))});
  }
  fmt::print("{}\n\n", controller);
  print_table({"falls by (cm)", "outcome", "published", "1st step (N s)", "published", "2nd step (N s)",
               "published", "1st, by force", "2nd, by force"},
              rows);
  fmt::print("\n");
}

/// Touchdowns before the edge, behind the transient of the start.
void print_flat(const StepDownTest& test, const std::vector<StepDownShare>& cells) {
  std::vector<double> up, forward, force, speed;
  for (const StepDownShare& cell : cells) {
    for (const StepDownRun& run : cell.runs) {
      for (std::size_t k = 2; k < run.touchdowns.size(); ++k) {
        const Touchdown& one = run.touchdowns[k];
        if (!one.lower) {
          up.push_back(one.impulse.z());
          forward.push_back(one.impulse.x());
          force.push_back(one.force_impulse);
          speed.push_back(one.speed);
        }
      }
    }
  }
  fmt::print(
      "On level ground, before the edge: {} N s up (published {:.1f} +- {:.1f}), {} N s forward; the "
      "simulated "
      "force over {:.0f} ms {} N s; the hip at {:.2f} m/s just before.\n",
      text(validation::spread_of(up)), test.flat, test.flat_deviation, text(validation::spread_of(forward)),
      1e3 * test.force_time, text(validation::spread_of(force)), validation::spread_of(speed).mean);
}

nlohmann::json to_json(const StepDownShare& cell) {
  nlohmann::json json{
      {"controller", cell.controller}, {"height", cell.height}, {"runs", nlohmann::json::array()}};
  for (const StepDownRun& run : cell.runs) {
    nlohmann::json one{{"outcome", outcome_text({cell.controller, cell.height, {run}})},
                       {"end", run.end},
                       {"touchdowns", nlohmann::json::array()}};
    for (const Touchdown& touchdown : run.touchdowns) {
      one["touchdowns"].push_back({{"time", touchdown.time},
                                   {"lower", touchdown.lower},
                                   {"impulse", {touchdown.impulse.x(), touchdown.impulse.z()}},
                                   {"force_impulse", touchdown.force_impulse},
                                   {"speed", touchdown.speed}});
    }
    if (run.behind_edge(1) != nullptr) {
      one["lean"] = {run.lowest_torso, run.highest_torso};
    }
    json["runs"].push_back(one);
  }
  return json;
}

void keep_one(StepDownTest& test, const std::string& name) {
  std::vector<std::string> known;
  std::vector<StepDownTest::Controller> kept;
  for (const StepDownTest::Controller& one : test.controllers) {
    known.push_back(one.name);
    if (one.name == name) {
      kept.push_back(one);
    }
  }
  if (kept.empty()) {
    throw InputError({"", 0, "--controller"}, "\"" + name + "\"",
                     "a controller of " + test.file + nearest_names(name, known));
  }
  test.controllers = kept;
}

void run(const StepDownArguments& arguments) {
  if (workers().is_first()) {
    check_writable(arguments.json);
  }
  StepDownTest test = validation::read_step_down(arguments.file);
  if (!arguments.controller.empty()) {
    keep_one(test, arguments.controller);
  }
  if (!arguments.heights.empty()) {
    test.heights.clear();
    for (const double height : arguments.heights) {
      test.heights.push_back(0.01 * height);
    }
  }
  validation::StepDownOptions options = arguments.options;
  options.stop = &stop_flag();
  options.workers = &workers();
  std::vector<std::string> files{test.file, test.scenario.scenario.file, test.scenario.model.file};
  for (const StepDownTest::Controller& controller : test.controllers) {
    files.push_back(controller.setup.file);
  }
  check_same_files(files);
  ProgressLine line;
  const validation::Progress show = line.callback();
  const std::vector<StepDownShare> cells =
      validation::step_down_all(test, options, [&](double done) { show("runs", done); });
  if (!workers().is_first()) {
    return;
  }
  fmt::print(
      "{}: the ground falls at {:.1f} m; passed: {} touchdowns below; the fuse breaks at {:.0f} N s up.\n\n",
      test.title, test.edge, test.enough, test.fuse);
  for (const StepDownTest::Controller& controller : test.controllers) {
    print_controller(test, cells, controller.name);
  }
  print_flat(test, cells);
  nlohmann::json json{{"file", test.file}, {"cells", nlohmann::json::array()}};
  for (const StepDownShare& cell : cells) {
    json["cells"].push_back(to_json(cell));
  }
  write_json(json, arguments.json);
}

}  // namespace

void add_step_down(CLI::App& app) {
  auto arguments = std::make_shared<StepDownArguments>();
  CLI::App* const command = app.add_subcommand(
      "step-down",
      "Let a walking robot step down: outcomes and contact intensities beside what was published");
  command->add_option("file", arguments->file, "a step_down file")->required()->type_name("FILE");
  command->add_option("--controller", arguments->controller, "only this one of the file's controllers")
      ->type_name("NAME");
  command->add_option("--height", arguments->heights, "these heights, in cm, in place of the file's");
  command
      ->add_option("--starts", arguments->options.starts,
                   "starts for each height: 1 is the scenario's own, more are drawn from its ranges")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--seed", arguments->options.seed, "of the starts")->capture_default_str();
  add_json_option(*command, arguments->json);
  command->footer(
      "Contact intensity: the vertical impulse of the rigid impact at the state just before a touchdown, on "
      "the "
      "design model.\n\nExample:\n  plumbline study step-down robots/mabel/step_down.yaml --starts 24");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace plumbline::cli
