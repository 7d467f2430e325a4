#include <fmt/core.h>

#include <cstdio>

#include "simulator/trace/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/ranks.h"
#include "validation/control/tune/tune.h"

namespace plumbline::cli {
namespace {

using validation::TuneResult;

struct Options {
  std::string file, save, json;
  validation::PublishedOptions published;
  validation::TuneOptions tune;
  double tolerance = 1e-5;
};

/// The first constant of each entry stands for those that share its factor.
std::vector<std::string> head_of(const validation::TuneFile& file, const validation::PublishedGait& gait) {
  std::vector<std::string> head{"cost", "sustained"};
  for (const validation::Searched& searched : file.searched) {
    head.push_back(searched.constants.front());
  }
  for (const validation::PublishedQuantity& quantity : validation::quantities_of_a_cycle(gait)) {
    head.push_back(quantity.measure.text);
  }
  return head;
}

std::vector<std::string> row_of(const TuneResult& result, const validation::TuneFile& file,
                                const validation::PublishedGait& gait) {
  std::vector<std::string> row{fmt::format("{:.3f}", result.cost),
                               fmt::format("{}/{}", result.share.sustained, result.share.runs)};
  for (const validation::Searched& searched : file.searched) {
    const std::size_t c = gait.loaded.controller->constant_index(searched.constants.front());
    row.push_back(fmt::format("{:.4g}", result.constants[c]));
  }
  for (const double mean : result.means) {
    row.push_back(fmt::format("{:.4g}", mean));
  }
  return row;
}

/// A row at once: a search takes long, and may be stopped.
void print_now(const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) {
    fmt::print("  {:>9}", cell);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void save(const Options& options, const validation::TuneFile& file, const validation::PublishedGait& gait,
          const TuneResult& best) {
  run::ControllerSetup setup = *gait.loaded.controller;
  setup.constants = best.constants;
  std::vector<std::string> names;
  for (const validation::Searched& searched : file.searched) {
    names.insert(names.end(), searched.constants.begin(), searched.constants.end());
  }
  run::write_constants(
      options.save, setup.file, setup, names,
      fmt::format("search on {}, seed {}: {} of {} starts reach {} cycles", gait.loaded.scenario.model,
                  options.tune.seed, best.share.sustained, best.share.runs, options.tune.enough),
      "found by search");
}

void run(Options options) {
  if (workers().is_first()) {
    check_writable(options.json);
    check_writable(options.save);
  }
  validation::TuneFile file = validation::read_tune(options.file);
  options.published.gait = file.gait;
  const validation::PublishedRobot robot = validation::read_published(file.published, options.published);
  const validation::PublishedGait& gait = robot.gaits.front();
  if (!gait.loaded.controller) {
    throw InputError({gait.loaded.scenario.file, 0, "controller"}, "none",
                     "a controller whose constants are searched");
  }
  check_not_an_input(options.save, {options.file, gait.loaded.controller->file});
  validation::check_searched(file, *gait.loaded.controller);
  check_same_files({options.file, file.published, gait.loaded.scenario.file, gait.loaded.model.file,
                    gait.loaded.controller->file});
  options.tune.run.integrator.set_tolerance(options.tolerance);
  options.tune.stop = &stop_flag();
  options.tune.workers = &workers();
  print_now(head_of(file, gait));
  const TuneResult best =
      validation::tune(gait, file.searched, options.tune,
                       [&](int, const TuneResult& result) { print_now(row_of(result, file, gait)); });
  if (!workers().is_first()) {
    return;
  }
  fmt::print("\n{}:\n", best.interrupted ? "Stopped before the end. The best so far" : "The best");
  print_now(row_of(best, file, gait));
  if (!options.save.empty()) {
    save(options, file, gait, best);
  }
  nlohmann::json json{{"cost", best.cost},
                      {"sustained", best.share.sustained},
                      {"starts", best.share.runs},
                      {"interrupted", best.interrupted}};
  for (const validation::Searched& searched : file.searched) {
    for (const std::string& name : searched.constants) {
      json["constants"][name] = best.constants[gait.loaded.controller->constant_index(name)];
    }
  }
  write_json(json, options.json);
}

}  // namespace

void add_tune(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "tune", "Search for constants of a controller that bring a gait near what was published about it");
  command->add_option("file", options->file, "which constants are searched, and for which gait")
      ->required()
      ->type_name("TUNE_FILE");
  command->add_option("--trials", options->tune.trials, "sets that are tried")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--starts", options->tune.starts, "random starts of each set")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--enough", options->tune.enough, "cycles that end a run")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--width", options->tune.width, "first standard deviation, in the logarithm")
      ->capture_default_str()
      ->check(between(0.01, 2.0));
  command->add_option("--seed", options->tune.seed, "seed of starts and search")->capture_default_str();
  command
      ->add_option("--scenario", options->published.scenario,
                   "another scenario than the published file names")
      ->type_name("FILE");
  command->add_option("--model", options->published.files.model, "another model than the scenario names")
      ->type_name("FILE");
  command
      ->add_option("--controller", options->published.files.controller,
                   "another controller's file to begin with")
      ->type_name("FILE");
  command->add_option("--tolerance", options->tolerance, "relative tolerance of the integrator")
      ->capture_default_str()
      ->check(between(1e-13, 1e-1));
  command->add_option("--save", options->save, "write the best constants as a controller's file")
      ->type_name("FILE");
  add_json_option(*command, options->json);
  command->footer("Example:\n  plumbline tune robots/mabel/tune/hopping.yaml --trials 200 --save mine.yaml");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
