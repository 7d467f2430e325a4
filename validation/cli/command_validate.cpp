#include <fmt/core.h>

#include <cmath>
#include <filesystem>

#include "simulator/trace/error.h"
#include "simulator/trace/units.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/ranks.h"
#include "validation/control/published/validate.h"
#include "validation/studies/running/published_running.h"

namespace plumbline::cli {
namespace {

namespace fs = std::filesystem;
using validation::GaitValidation;
using validation::Verdict;
using Relation = validation::PublishedQuantity::Relation;

struct Options {
  std::string robot, json;
  validation::PublishedOptions published;
  validation::ValidateOptions run;
  double tolerance = 1e-5;
  bool no_orbit = false, no_held = false;
  std::vector<std::string> models;
};

/// The ranks of a job have the same results; one of them writes.
void write_results(const nlohmann::json& json, const Options& options) {
  if (workers().is_first()) {
    write_json(json, options.json);
  }
}

/// What all ranks must read alike.
void check_inputs(const validation::PublishedRobot& robot) {
  std::vector<std::string> files{robot.file};
  for (const validation::PublishedGait& gait : robot.gaits) {
    files.insert(files.end(), {gait.loaded.scenario.file, gait.loaded.model.file});
    if (gait.loaded.controller) {
      files.push_back(gait.loaded.controller->file);
    }
  }
  check_same_files(files);
}

std::string published_file(const std::string& robot) {
  if (fs::is_directory(robot)) {
    return (fs::path(robot) / "published.yaml").string();
  }
  if (!fs::exists(robot)) {
    throw InputError({robot, 0, ""}, "no such folder or file",
                     "a robot's folder with published.yaml, or that file");
  }
  return robot;
}

/// In the unit of the published file.
std::string number(const Verdict& verdict, double si) {
  return fmt::format("{:.4g}", si / to_si_factor(verdict.unit));
}

std::string unit_of(const Verdict& verdict) { return verdict.unit == "1" ? "" : " " + verdict.unit; }

std::string published_text(const Verdict& verdict) {
  const std::string value = number(verdict, verdict.published) + unit_of(verdict);
  switch (verdict.relation) {
    case Relation::at_most:
      return "at most " + value;
    case Relation::at_least:
      return "at least " + value;
    case Relation::value:
      break;
  }
  return value;
}

std::string simulated_text(const Verdict& verdict) {
  if (!verdict.simulated) {
    return "-";
  }
  const std::string spread =
      verdict.simulated->count > 1 ? " +- " + number(verdict, verdict.simulated->deviation) : "";
  return number(verdict, verdict.simulated->mean) + spread + unit_of(verdict);
}

std::string verdict_text(const Verdict& verdict) {
  if (!verdict.simulated) {
    return "not measured";
  }
  return verdict.outside == 0.0
             ? "within"
             : "outside by " + number(verdict, std::abs(verdict.outside)) + unit_of(verdict);
}

void print(const GaitValidation& done, long enough) {
  fmt::print("{}: {}\n\n", done.gait, done.title);
  std::vector<std::vector<std::string>> rows;
  for (const Verdict& verdict : done.verdicts) {
    rows.push_back({verdict.name, !verdict.curve.channel.empty() ? "curve" : published_text(verdict),
                    simulated_text(verdict), number(verdict, verdict.tolerance) + unit_of(verdict),
                    verdict_text(verdict), verdict.remark});
  }
  print_table({"quantity", "published", "simulated", "tolerance", "verdict", ""}, rows);
  if (!done.shares.empty()) {
    fmt::print("\nWithout a published counterpart:\n\n");
    rows.clear();
    for (const validation::Share& share : done.shares) {
      rows.push_back({share.what, fmt::format("{} of {}", share.sustained, share.runs),
                      fmt::format("{:.0f}", share.median_cycles)});
    }
    print_table({"runs", fmt::format("sustain {} cycles", enough), "median"}, rows);
  }
  fmt::print("\nA cycle lasts {:.3f} s on average.\n", done.duration);
  if (done.not_measured() > 0) {
    fmt::print("{} of {} published quantities were not measured: the gait does not pass.\n",
               done.not_measured(), done.verdicts.size());
  }
  fmt::print("\n");
}

nlohmann::json numbers_of(const Eigen::VectorXd& values, double divide_by) {
  nlohmann::json json = nlohmann::json::array();
  for (const double value : values) {
    json.push_back(json_number(value / divide_by));
  }
  return json;
}

nlohmann::json to_json(const Verdict::Curve& curve, double si) {
  return {{"channel", curve.channel},
          {curve.over_shares ? "share" : "t", numbers_of(curve.at, 1.0)},
          {"published", numbers_of(curve.published, si)},
          {"spread", numbers_of(curve.spread, si)},
          {"simulated", numbers_of(curve.simulated, si)},
          {"deviation", numbers_of(curve.deviation, si)}};
}

nlohmann::json to_json(const Verdict& verdict) {
  const double si = to_si_factor(verdict.unit);
  nlohmann::json json{{"name", verdict.name},
                      {"measure", verdict.measure},
                      {"relation", to_string(verdict.relation)},
                      {"unit", verdict.unit},
                      {"published", verdict.published / si},
                      {"tolerance", verdict.tolerance / si},
                      {"source", verdict.source},
                      {"remark", verdict.remark},
                      {"simulated", nullptr}};
  if (verdict.simulated) {
    json["simulated"] = {{"mean", verdict.simulated->mean / si},
                         {"deviation", verdict.simulated->deviation / si},
                         {"count", verdict.simulated->count}};
    json["within"] = verdict.holds();
    if (!verdict.curve.channel.empty()) {
      json["curve"] = to_json(verdict.curve, si);
    }
    json["outside_by"] = verdict.outside / si;
  }
  return json;
}

nlohmann::json to_json(const validation::Orbit& orbit) {
  return {{"settled", orbit.settled},         {"found", orbit.found},
          {"why_not", orbit.why_not},         {"residual_steps", orbit.residual},
          {"rounds", orbit.rounds},           {"memory", orbit.memory},
          {"growth", orbit.growth},           {"growth_twice_step", orbit.growth_twice_step},
          {"growth_held", orbit.growth_held}, {"growth_held_twice_step", orbit.growth_held_twice_step}};
}

nlohmann::json to_json(const GaitValidation& done) {
  nlohmann::json json{{"gait", done.gait},
                      {"holds", done.holds()},
                      {"not_measured", done.not_measured()},
                      {"verdicts", nlohmann::json::array()},
                      {"shares", nlohmann::json::array()},
                      {"from_start", {{"cycles", done.run.cycles.size()}, {"end", done.run.run.end}}}};
  for (const Verdict& verdict : done.verdicts) {
    json["verdicts"].push_back(to_json(verdict));
  }
  for (const validation::Share& share : done.shares) {
    json["shares"].push_back({{"what", share.what},
                              {"sustained", share.sustained},
                              {"runs", share.runs},
                              {"median_cycles", share.median_cycles}});
  }
  json["orbit"] = done.orbit ? to_json(*done.orbit) : nlohmann::json();
  return json;
}

/// How far a verdict is off, in tolerances; nothing where it was not measured or has no tolerance.
std::optional<double> in_tolerances(const Verdict& verdict) {
  if (!verdict.simulated || !(verdict.tolerance > 0.0)) {
    return std::nullopt;
  }
  const bool curve = !verdict.curve.channel.empty();
  const double off = verdict.simulated->mean - (curve ? 0.0 : verdict.published);
  if ((verdict.relation == Relation::at_least && off > 0.0) ||
      (verdict.relation == Relation::at_most && !curve && off < 0.0)) {
    return 0.0;
  }
  return std::abs(off) / verdict.tolerance;
}

/// One gait on several models: a column for each, what is outside its tolerance marked.
void print_models(const std::vector<std::string>& models, const std::vector<GaitValidation>& done) {
  fmt::print("{}: {}\n\n", done.front().gait, done.front().title);
  std::vector<std::string> head{"quantity", "published"};
  std::vector<std::vector<std::string>> rows;
  for (const std::string& model : models) {
    head.push_back(fs::path(model).stem().string());
  }
  for (std::size_t v = 0; v < done.front().verdicts.size(); ++v) {
    const Verdict& first = done.front().verdicts[v];
    rows.push_back(
        {first.name, !first.curve.channel.empty() ? "curve, " + first.unit : published_text(first)});
    for (const GaitValidation& one : done) {
      const Verdict& verdict = one.verdicts[v];
      const bool outside = verdict.simulated && verdict.outside != 0.0;
      rows.back().push_back(
          !verdict.simulated ? "-" : number(verdict, verdict.simulated->mean) + (outside ? " *" : ""));
    }
  }
  rows.push_back({"root mean square, in tolerances", ""});
  rows.push_back({"steps or hops before the end", ""});
  for (const GaitValidation& one : done) {
    double sum = 0.0;
    int count = 0;
    for (const Verdict& verdict : one.verdicts) {
      if (const auto off = in_tolerances(verdict)) {
        sum += *off * *off;
        ++count;
      }
    }
    rows[rows.size() - 2].push_back(count > 0 ? fmt::format("{:.2f}", std::sqrt(sum / count)) : "-");
    rows.back().push_back(fmt::format("{}{}", one.run.cycles.size(), one.run.run.fell ? ", then ends" : ""));
  }
  print_table(head, rows);
  fmt::print("\n* outside its tolerance. A curve: root mean square difference.\n\n");
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (done[m].run.run.fell) {
      fmt::print("{}: {}\n", fs::path(models[m]).stem().string(), done[m].run.run.end);
    }
  }
}

/// The gaits on each of the models, in the order in which they are stated.
void run_models(Options& options, Outcome& outcome) {
  if (!options.published.files.model.empty()) {
    throw InputError({"", 0, "--model"}, "it and --models", "one of them");
  }
  std::vector<std::vector<GaitValidation>> done;  // by gait, then by model
  nlohmann::json json = nlohmann::json::array();
  bool holds = true;
  for (const std::string& model : options.models) {
    options.published.files.model = model;
    const validation::PublishedRobot robot =
        validation::read_published(published_file(options.robot), options.published);
    check_inputs(robot);
    done.resize(robot.gaits.size());
    for (std::size_t g = 0; g < robot.gaits.size(); ++g) {
      ProgressLine line;
      done[g].push_back(validation::validate(robot.gaits[g], options.run, line.callback()));
      nlohmann::json one = to_json(done[g].back());
      one["model"] = model;
      json.push_back(one);
      holds = holds && done[g].back().holds();
    }
  }
  for (const std::vector<GaitValidation>& gait : done) {
    print_models(options.models, gait);
  }
  write_results({{"models", json}, {"holds", holds}}, options);
  outcome.status = holds ? 0 : 1;
}

/// A motion on the paper's own model: no scenario, no starts.
void run_on_its_model(const std::string& file, const Options& options, Outcome& outcome) {
  const validation::PublishedRunning published = validation::read_published_running(file);
  const GaitValidation done = validation::validate_running(published);
  print(done, options.run.enough);
  write_results({{"robot", published.title}, {"gaits", {to_json(done)}}, {"holds", done.holds()}}, options);
  outcome.status = done.holds() ? 0 : 1;
}

void run(Options options, Outcome& outcome) {
  if (workers().is_first()) {
    check_writable(options.json);
  }
  const std::string file = published_file(options.robot);
  if (validation::is_published_running(file)) {
    run_on_its_model(file, options, outcome);
    return;
  }
  options.run.run.integrator.set_tolerance(options.tolerance);
  options.run.stop = &stop_flag();
  options.run.workers = &workers();
  options.run.orbit = !options.no_orbit;
  options.run.held = !options.no_held;
  if (!options.models.empty()) {
    run_models(options, outcome);
    return;
  }
  const validation::PublishedRobot robot = validation::read_published(file, options.published);
  check_inputs(robot);
  nlohmann::json json{{"robot", robot.title}, {"gaits", nlohmann::json::array()}};
  bool holds = true;
  for (const validation::PublishedGait& gait : robot.gaits) {
    ProgressLine line;
    const GaitValidation done = validation::validate(gait, options.run, line.callback());
    json["gaits"].push_back(to_json(done));
    print(done, options.run.enough);
    holds = holds && done.holds();
  }
  json["holds"] = holds;
  write_results(json, options);
  outcome.status = holds ? 0 : 1;
}

void add_numbers(CLI::App& command, Options& options) {
  command.add_option("--cycles", options.run.cycles, "cycles of the run from the scenario's start, at most")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command.add_option("--starts", options.run.starts, "random starts, drawn from the scenario's ranges")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command.add_option("--enough", options.run.enough, "cycles that count as sustained")
      ->capture_default_str()
      ->check(CLI::Range(15, 1000000));
  command
      .add_option("--draws", options.run.draws,
                  "robots with drawn masses, torque constants and cable stiffness")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_option("--within", options.run.share, "share within which they are drawn")
      ->capture_default_str()
      ->check(between(0.0, 0.5));
  command.add_option("--seed", options.run.seed, "seed of starts and drawn robots")->capture_default_str();
  command.add_option("--tolerance", options.tolerance, "relative tolerance of the integrator")
      ->capture_default_str()
      ->check(between(1e-13, 1e-1));
}

}  // namespace

void add_validate(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "validate", "Hold a simulated robot's gaits against what was published about the real one");
  command->add_option("robot", options->robot, "the robot's folder with published.yaml, or such a file")
      ->required()
      ->type_name("ROBOT");
  command->add_option("--gait", options->published.gait, "only this one of the published gaits")
      ->type_name("NAME");
  command
      ->add_option("--scenario", options->published.scenario,
                   "another scenario than the published file names")
      ->type_name("FILE");
  command->add_option("--model", options->published.files.model, "another model than the scenario names")
      ->type_name("FILE");
  command
      ->add_option(
          "--models", options->models,
          "these models in place of the scenario's, one after the other: a table with a column for each")
      ->type_name("FILE...");
  command->add_option("--controller", options->published.files.controller, "another controller's file")
      ->type_name("FILE");
  add_numbers(*command, *options);
  command->add_flag(
      "--no-orbit", options->no_orbit,
      "do not look for the orbit's multipliers, which takes minutes; they then count as not measured");
  command->add_flag("--no-held", options->no_held,
                    "do not repeat the starts with what the controller updates from cycle to cycle held");
  add_json_option(*command, options->json);
  command->footer(
      "Exit status 0 when everything published was measured and is within its tolerance, 1 otherwise.\n\n"
      "Example:\n  plumbline validate robots/mabel --gait hopping --starts 8 --no-orbit");
  command->callback([options, &outcome] { run(*options, outcome); });
}

}  // namespace plumbline::cli
