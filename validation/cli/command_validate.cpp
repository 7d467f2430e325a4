#include <fmt/core.h>

#include <cmath>
#include <filesystem>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "simulator/trace/units.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/hopping/hopping_file.h"
#include "validation/hopping/validate.h"

namespace plumbline::cli {
namespace {

namespace fs = std::filesystem;
using validation::Published;
using validation::PublishedVerdict;
using validation::Validation;

struct Options {
  std::string folder, model, controller, tuned_rigid, json;
  validation::ValidateOptions run;
  bool orbit = false, no_without = false;
};

validation::ValidateInputs read_inputs(const Options& options) {
  if (!fs::is_directory(options.folder)) {
    throw InputError({options.folder, 0, ""}, "no such folder", "a robot's folder with published.yaml");
  }
  const auto given_or = [](const std::string& given, const std::string& standard) {
    return given.empty() ? standard : given;
  };
  const validation::PublishedRobot robot =
      validation::read_published((fs::path(options.folder) / "published.yaml").string());
  validation::ValidateInputs inputs;
  inputs.published = robot.quantities;
  inputs.model = model::read_model(given_or(options.model, robot.model), model::known_effects());
  inputs.controller = validation::read_hopping(given_or(options.controller, robot.controller));
  const std::string rigid = given_or(options.tuned_rigid, robot.tuned_rigid);
  if (!rigid.empty()) {
    inputs.tuned_rigid = validation::read_hopping(rigid);
  }
  return inputs;
}

/// In the unit of the published file.
std::string number(const Published& published, double si) {
  return fmt::format("{:.4g}", si / to_si_factor(published.quantity.unit));
}

std::string unit_of(const Published& published) {
  return published.quantity.unit == "1" ? "" : " " + published.quantity.unit;
}

std::string published_text(const Published& published) {
  std::string value = number(published, published.quantity.value) + unit_of(published);
  switch (published.relation) {
    case Published::Relation::at_most:
      return "at most " + value;
    case Published::Relation::at_least:
      return "at least " + value;
    case Published::Relation::value:
      break;
  }
  return value;
}

std::string simulated_text(const PublishedVerdict& verdict) {
  if (!verdict.simulated) {
    return "-";
  }
  const std::string mean = number(verdict.published, verdict.simulated->mean);
  const std::string spread =
      verdict.simulated->count > 1 ? " +- " + number(verdict.published, verdict.simulated->deviation) : "";
  return mean + spread + unit_of(verdict.published);
}

std::string verdict_text(const PublishedVerdict& verdict) {
  if (!verdict.simulated) {
    return "not measured";
  }
  const double outside = verdict.published.outside(verdict.simulated->mean);
  return outside == 0.0
             ? "within"
             : "outside by " + number(verdict.published, std::abs(outside)) + unit_of(verdict.published);
}

void print(const Validation& done, long enough) {
  std::vector<std::vector<std::string>> rows;
  for (const PublishedVerdict& verdict : done.verdicts) {
    rows.push_back({verdict.published.name, published_text(verdict.published), simulated_text(verdict),
                    verdict_text(verdict), verdict.remark});
  }
  print_table({"quantity", "published", "simulated", "verdict", ""}, rows);
  fmt::print("\nWithout a published counterpart:\n\n");
  rows.clear();
  for (const validation::Share& share : done.shares) {
    rows.push_back({share.what, fmt::format("{} of {}", share.sustained, share.runs),
                    fmt::format("{:.0f}", share.median_hops)});
  }
  print_table({"runs", fmt::format("sustain {} hops", enough), "median"}, rows);
  const validation::HopStatistics& s = done.statistics;
  fmt::print(
      "\nPeriod {:.3f} s; largest torque {:.1f} N m (leg angle), {:.1f} N m (leg shape); torque at its limit "
      "for "
      "{:.1f} ms of a hop.\n",
      s.period, s.torque_mLA, s.torque_mLS, 1e3 * s.time_at_limit);
}

nlohmann::json to_json(const PublishedVerdict& verdict) {
  const Published& p = verdict.published;
  const double si = to_si_factor(p.quantity.unit);
  nlohmann::json json{{"name", p.name},
                      {"measure", p.measure->name},
                      {"relation", to_string(p.relation)},
                      {"unit", p.quantity.unit},
                      {"published", p.quantity.value / si},
                      {"tolerance", p.tolerance.value / si},
                      {"source", p.quantity.source},
                      {"remark", verdict.remark},
                      {"simulated", nullptr}};
  if (verdict.simulated) {
    json["simulated"] = {{"mean", verdict.simulated->mean / si},
                         {"deviation", verdict.simulated->deviation / si},
                         {"count", verdict.simulated->count}};
    json["within"] = verdict.holds();
    json["outside_by"] = p.outside(verdict.simulated->mean) / si;
  }
  return json;
}

nlohmann::json to_json(const validation::Orbit& orbit) {
  return {{"settled", orbit.settled},
          {"found", orbit.found},
          {"why_not", orbit.why_not},
          {"residual_steps", orbit.residual},
          {"rounds", orbit.rounds},
          {"h_T_d", orbit.h_T_d},
          {"growth", orbit.growth},
          {"growth_twice_step", orbit.growth_twice_step},
          {"growth_without_update", orbit.growth_without_update},
          {"growth_without_update_twice_step", orbit.growth_without_twice_step}};
}

nlohmann::json to_json(const Validation& done) {
  nlohmann::json json{{"holds", done.holds()},
                      {"verdicts", nlohmann::json::array()},
                      {"shares", nlohmann::json::array()},
                      {"default_start", {{"hops", done.run.hops.size()}, {"end", done.run.end}}}};
  for (const PublishedVerdict& verdict : done.verdicts) {
    json["verdicts"].push_back(to_json(verdict));
  }
  for (const validation::Share& share : done.shares) {
    json["shares"].push_back({{"what", share.what},
                              {"sustained", share.sustained},
                              {"runs", share.runs},
                              {"median_hops", share.median_hops}});
  }
  json["orbit"] = done.orbit ? to_json(*done.orbit) : nlohmann::json();
  return json;
}

void run(Options options, Outcome& outcome) {
  check_writable(options.json);
  const validation::ValidateInputs inputs = read_inputs(options);
  integrate::Options& integrator = options.run.run.integrator;
  integrator.set_tolerance(integrator.relative_tolerance);
  options.run.run.stop = &stop_flag();
  options.run.orbit = options.orbit;
  options.run.without = !options.no_without;
  ProgressLine line;
  const Validation done = validation::validate(inputs, options.run, line.callback());
  write_json(to_json(done), options.json);
  print(done, options.run.enough);
  outcome.status = done.holds() ? 0 : 1;
}

void add_numbers(CLI::App& command, Options& options) {
  command.add_option("--hops", options.run.hops, "hops of the run from the default start, at most")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command.add_option("--starts", options.run.starts, "random starts (see plumbline hop)")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command.add_option("--enough", options.run.enough, "hops that count as sustained")
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
  command
      .add_option("--tolerance", options.run.run.integrator.relative_tolerance,
                  "relative tolerance of the integrator")
      ->capture_default_str()
      ->check(between(1e-13, 1e-1));
}

}  // namespace

void add_validate(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "validate", "Hold the simulated hopping robot against what was published about the real one");
  command->add_option("robot", options->folder, "folder with published.yaml, the model and the controller")
      ->required()
      ->type_name("ROBOT_FOLDER");
  command->add_option("--model", options->model, "another model than published.yaml names")
      ->type_name("FILE");
  command->add_option("--controller", options->controller, "other constants of the controller")
      ->type_name("FILE");
  command
      ->add_option("--tuned-rigid", options->tuned_rigid, "other constants that were found on rigid cables")
      ->type_name("FILE");
  add_numbers(*command, *options);
  command->add_flag("--orbit", options->orbit, "look for the orbit's multipliers too, which takes minutes");
  command->add_flag("--no-without", options->no_without, "do not repeat the starts without the update");
  add_json_option(*command, options->json);
  command->footer(
      "Exit status 0 when all that was measured is within its tolerance, 1 otherwise.\n\n"
      "Example:\n  plumbline validate robots/mabel --model robots/mabel/mabel.yaml --controller "
      "robots/mabel/hopping_boom.yaml --draws 20");
  command->callback([options, &outcome] { run(*options, outcome); });
}

}  // namespace plumbline::cli
