#include <fmt/core.h>

#include <cstdio>
#include <stdexcept>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/hop_report.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/platforms.h"
#include "validation/hopping/hop_search.h"
#include "validation/hopping/hopping_file.h"
#include "validation/hopping/published.h"
#include "validation/hopping/recorded_trial.h"
#include "validation/trial/write_trial.h"

namespace plumbline::cli {
namespace {

using validation::HopRun;
using validation::HopStatistics;

constexpr double kDegrees = 57.295779513082323;

struct Options {
  std::string model, controller, out, record, save, json;
  validation::HopStart start;
  validation::HopOptions run;
  int starts = 1;
  long enough = 40;
  std::uint64_t seed = 1;
  bool no_update = false;
  int search = 0;
  std::string published;
  validation::Role role = validation::Role::train;
  bool sides = false;
  double width = 0.4;
  Platforms platforms;
};

nlohmann::json to_json(const HopRun& run) {
  return {{"hops", hops_json(run)},
          {"time", run.time},
          {"fell", run.fell},
          {"end", run.end},
          {"time_at_limit", run.time_at_limit},
          {"steps", run.summary.steps},
          {"rate_evaluations", run.summary.rate_evaluations},
          {"wall_time_per_simulated_second", run.time > 0.0 ? run.seconds / run.time : 0.0}};
}

nlohmann::json to_json(const HopStatistics& s) {
  return {{"starts", s.starts},
          {"sustained", s.sustained},
          {"median_hops", s.median_hops},
          {"period", s.period},
          {"travel", s.travel},
          {"torso", s.torso},
          {"touchdown_gap", s.touchdown_gap},
          {"stretch_LA", s.stretch_LA},
          {"stretch_LS", s.stretch_LS},
          {"torque_mLA", s.torque_mLA},
          {"torque_mLS", s.torque_mLS},
          {"time_at_limit", s.time_at_limit}};
}

void print(const HopStatistics& s, long enough) {
  fmt::print("{} of {} starts sustained ({} hops or more); median {:.0f} hops.\n\n", s.sustained, s.starts,
             enough, s.median_hops);
  print_table({"over the settled hops", "mean"},
              {{"period", fmt::format("{:.3f} s", s.period)},
               {"travel of a hop", fmt::format("{:.3f} m", s.travel)},
               {"torso at landing", fmt::format("{:.1f} deg", s.torso * kDegrees)},
               {"between the two touchdowns", fmt::format("{:.1f} ms", 1e3 * s.touchdown_gap)},
               {"largest stretch, leg angle", fmt::format("{:.0f} deg of motor", s.stretch_LA * kDegrees)},
               {"largest stretch, leg shape", fmt::format("{:.0f} deg of motor", s.stretch_LS * kDegrees)},
               {"largest torque, leg angle", fmt::format("{:.1f} N m", s.torque_mLA)},
               {"largest torque, leg shape", fmt::format("{:.1f} N m", s.torque_mLS)},
               {"torque at its limit, all motors", fmt::format("{:.1f} ms", 1e3 * s.time_at_limit)}});
}

void run_once(const Options& options, const model::Model& model, const controllers::HoppingConfig& config) {
  validation::HopOptions run_options = options.run;
  run_options.trace = !options.out.empty() || !options.record.empty();
  const HopRun run = validation::hop(model, config, options.start, run_options);
  if (!options.out.empty()) {
    write_trace(run.trace, options.out);
  }
  if (!options.record.empty()) {
    validation::Trial trial = validation::recorded_trial(model, run.trace, options.seed);
    trial.role = options.role;
    validation::write_trial(trial, model, options.record);
  }
  write_json(to_json(run), options.json);
  print_hops(run);
}

void run_many(const Options& options, const model::Model& model, const controllers::HoppingConfig& config) {
  ProgressLine line;
  const validation::Progress show = line.callback();
  const std::vector<validation::HopStart> starts = validation::draw_starts(options.starts, options.seed);
  const std::vector<HopRun> runs = validation::hop_from(model, config, starts, options.run, [&](int done) {
    show("hopping", static_cast<double>(done) / options.starts);
  });
  const HopStatistics statistics = validation::statistics_of(runs, options.enough);
  nlohmann::json json = to_json(statistics);
  json["runs"] = nlohmann::json::array();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    json["runs"].push_back({{"drop", starts[r].drop},
                            {"speed", starts[r].speed},
                            {"torso", starts[r].torso},
                            {"hops", runs[r].hops.size()},
                            {"end", runs[r].end}});
  }
  write_json(json, options.json);
  print(statistics, options.enough);
}

std::vector<std::string> describe(const validation::HopSearchResult& r, bool sides) {
  const HopStatistics& s = r.statistics;
  std::vector<std::string> row{fmt::format("{:.3f}", r.cost), fmt::format("{}/{}", s.sustained, s.starts)};
  for (const validation::Searched& searched : validation::searched_values(r.config, sides)) {
    row.push_back(fmt::format("{:.4g}", searched.value));
  }
  row.push_back(fmt::format("{:.3f}", s.travel));
  row.push_back(fmt::format("{:.1f}", s.torso * kDegrees));
  row.push_back(fmt::format("{:.0f}", 1e3 * s.touchdown_gap));
  row.push_back(fmt::format("{:.0f}", std::max(s.stretch_LA, s.stretch_LS) * kDegrees));
  return row;
}

std::vector<std::string> search_head(const controllers::HoppingConfig& config, bool sides) {
  std::vector<std::string> head{"cost", "sustained"};
  for (const validation::Searched& searched : validation::searched_values(config, sides)) {
    head.push_back(searched.name);
  }
  for (const char* name : {"travel m", "torso deg", "gap ms", "stretch deg"}) {
    head.emplace_back(name);
  }
  return head;
}

/// A row at once: a search takes long, and may be stopped.
void print_now(const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) {
    fmt::print("  {:>9}", cell);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void run_search(const Options& options, const model::Model& model, const controllers::HoppingConfig& config) {
  validation::HopSearchOptions search;
  search.trials = options.search;
  search.starts = std::max(options.starts, 2);
  search.hops = options.run.hops;
  search.seed = options.seed;
  search.sides = options.sides;
  search.width = options.width;
  search.run = options.run;
  search.published = validation::read_published(options.published).quantities;
  print_now(search_head(config, options.sides));
  const validation::HopSearchResult best = validation::search_gains(
      model, config, search,
      [&](int, const validation::HopSearchResult& result) { print_now(describe(result, options.sides)); });
  fmt::print("\n{}:\n", best.interrupted ? "Stopped before the end. The best so far" : "The best");
  print_now(describe(best, options.sides));
  if (!options.save.empty()) {
    const HopStatistics& s = best.statistics;
    validation::write_gains(options.save, options.controller, best.config,
                            fmt::format("search on {}, seed {}: {} of {} starts reach {} hops", options.model,
                                        options.seed, s.sustained, s.starts, search.hops));
  }
  nlohmann::json json{{"cost", best.cost}, {"statistics", to_json(best.statistics)}};
  for (const validation::Searched& searched : validation::searched_values(best.config, options.sides)) {
    json["gains"][searched.name] = searched.value;
  }
  write_json(json, options.json);
}

void run(Options options) {
  check_trace_file(options.out);
  check_writable(options.json);
  check_new_folder(options.record);
  check_not_an_input(options.out, {options.model, options.controller});
  check_writable(options.save);
  check_not_an_input(options.save, {options.model, options.controller});
  const bool keeps_samples = !options.out.empty() || !options.record.empty();
  if (keeps_samples && (options.starts > 1 || options.search > 0)) {
    throw InputError({"", 0, options.out.empty() ? "--record" : "--out"}, "more than one run",
                     "a single run for a trace or a trial");
  }
  if (options.search > 0 && options.published.empty()) {
    throw InputError({"", 0, "--search"}, "no --published", "the file of published values to search for");
  }
  const model::Model model = model::read_model(options.model, model::known_effects());
  controllers::HoppingConfig config = validation::read_hopping(options.controller);
  config.parameters.event_update = config.parameters.event_update && !options.no_update;
  integrate::Options& integrator = options.run.integrator;
  integrator.set_tolerance(integrator.relative_tolerance);
  options.run.stop = &stop_flag();
  options.run.terrain = terrain_of(options.platforms);
  if (options.search > 0) {
    run_search(options, model, config);
  } else if (options.starts > 1) {
    run_many(options, model, config);
  } else {
    run_once(options, model, config);
  }
}

}  // namespace

void add_hop(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("hop", "Hop on two legs under the hopping controller, from one start or many");
  command->add_option("model", options->model, "model file with two feet on the ground")
      ->required()
      ->type_name("MODEL");
  command->add_option("controller", options->controller, "the controller's constants")
      ->required()
      ->type_name("FILE");
  command->add_option("--drop", options->start.drop, "height of the lower foot at the start, m")
      ->capture_default_str()
      ->check(between(0.0, 1.0));
  command->add_option("--speed", options->start.speed, "forward speed at the start, m/s")
      ->capture_default_str()
      ->check(between(-10.0, 10.0));
  command->add_option("--torso", options->start.torso, "torso beyond its nominal angle at the start, rad")
      ->capture_default_str()
      ->check(between(-1.6, 1.6));
  command->add_option("--hops", options->run.hops, "end a run after so many hops")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_flag("--no-update", options->no_update, "without the event-based update of the torso angle");
  command
      ->add_option("--starts", options->starts,
                   "random starts: drop 3 to 7 cm, speed -0.6 to -0.1 m/s, torso +-0.02 rad")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--enough", options->enough, "hops that count as sustained")->capture_default_str();
  command->add_option("--search", options->search, "look for gains, trying so many sets")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--platform", options->platforms,
                   "a step in the ground: from and to along the way, height, m (again for more)")
      ->type_name("FROM TO HEIGHT");
  command->add_option("--published", options->published, "with --search: what the gait is held against")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command->add_option("--save", options->save, "with --search: write the best gains as a controller file")
      ->type_name("FILE")
      ->needs("--search");
  command->add_flag("--sides", options->sides, "with --search: left and right may have different gains");
  command->add_option("--width", options->width, "with --search: first standard deviation, in the logarithm")
      ->capture_default_str()
      ->check(between(0.01, 2.0));
  command->add_option("--seed", options->seed, "seed of starts and search")->capture_default_str();
  command
      ->add_option("--tolerance", options->run.integrator.relative_tolerance,
                   "relative tolerance of the integrator")
      ->capture_default_str()
      ->check(between(1e-13, 1e-1));
  command->add_option("-o,--out", options->out, "write the trace of a single run to FILE (.csv or .mat)")
      ->type_name("FILE");
  command
      ->add_option("--record", options->record,
                   "write a single run to the folder DIR as a trial: what the robot's sensors would record")
      ->type_name("DIR");
  command->add_option("--role", options->role, "train or held-out")
      ->needs("--record")
      ->transform(CLI::CheckedTransformer(std::map<std::string, validation::Role>{
          {"train", validation::Role::train}, {"held-out", validation::Role::held_out}}))
      ->type_name("ROLE");
  add_json_option(*command, options->json);
  command->footer(
      "Example:\n  plumbline hop robots/mabel/mabel.yaml robots/mabel/hopping.yaml -o hops.csv\n"
      "  plumbline hop robots/mabel/mabel.yaml robots/mabel/hopping.yaml --starts 48 --hops 40");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
