#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/studies/spring_mass/drawing.h"
#include "validation/studies/spring_mass/sensitivity.h"
#include "validation/studies/spring_mass/theory_report.h"

namespace plumbline::cli {
namespace {

namespace sm = plumbline::spring_mass;

using sm::degree;

struct Options {
  std::string scan, reference, output, law = "deadbeat", json;
  double target = 1.1, tiles = 0.25;
  int steps = 500, trails = 4, seed = 1;
};

/// The scan from the file, or made and kept there.
sm::Behaviour scanned(const Options& options) {
  sm::Behaviour behaviour(sm::Body{}, sm::Grid{});
  if (!options.scan.empty() && behaviour.recall(options.scan)) {
    fmt::print("Scan read from {}.\n", options.scan);
    return behaviour;
  }
  check_writable(options.scan);
  const auto start = std::chrono::steady_clock::now();
  behaviour.scan();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  const sm::Grid& grid = behaviour.grid();
  fmt::print("Scan of {} x {} x {} steps: {:.1f} s.\n", grid.attacks, grid.splays, grid.apexes, took.count());
  if (!options.scan.empty()) {
    behaviour.keep(options.scan);
  }
  return behaviour;
}

std::string cell_text(const sm::Cell& cell, bool one_number) {
  if (cell.fallen > 0) {
    return fmt::format("fell {}", cell.fallen);
  }
  return one_number ? fmt::format("{:.2f}", cell.mean)
                    : fmt::format("{:.1f} ({:.1f}..{:.1f})", cell.mean, cell.least, cell.most);
}

/// The published row of this one; the energy as ground stands beside the row of the energy.
const sm::PublishedRow* published_of(const std::vector<sm::PublishedRow>& table,
                                     const sm::SensitivityRow& row) {
  const std::string parameter = row.parameter == "E of ground" ? "E" : row.parameter;
  for (const sm::PublishedRow& one : table) {
    if (one.parameter == parameter && one.value == row.value) {
      return &one;
    }
  }
  return nullptr;
}

void run_table(const Options& options) {
  std::vector<sm::PublishedRow> published;
  if (!options.reference.empty()) {
    published = sm::read_published_table(options.reference);
  }
  const sm::Behaviour behaviour = scanned(options);
  const sm::DeadbeatLaw law(behaviour, options.target);
  const auto results = sm::sensitivity(law, options.trails, options.steps);
  const char* names[] = {"steady e_z [cm]", "RMS e_z [cm]", "max e_z [cm]", "RMS e_dtheta [deg]",
                         "max e_dtheta [deg]"};
  int equal = 0, within = 0, outside = 0;
  for (int m = 0; m < sm::measures; ++m) {
    std::vector<std::vector<std::string>> rows;
    for (const sm::SensitivityResult& one : results) {
      std::vector<std::string> cells{one.row.parameter, one.row.value};
      const sm::PublishedRow* beside = published_of(published, one.row);
      for (int l = 0; l < sm::laws; ++l) {
        if (l == 2 && !one.row.with_classical) {
          cells.insert(cells.end(), {"-", ""});
          continue;
        }
        const sm::Cell& cell = one.cells[static_cast<std::size_t>(l)][static_cast<std::size_t>(m)];
        cells.push_back(cell_text(cell, m == 0));
        std::string text;
        if (beside != nullptr) {
          const double value = beside->cells[static_cast<std::size_t>(l)][static_cast<std::size_t>(m)];
          const std::string says = sm::verdict(cell, value);
          text = fmt::format("{:.1f} {}", value, says);
          if (one.row.parameter != "E of ground") {
            equal += says == "=" ? 1 : 0;
            within += says == "~" ? 1 : 0;
            outside += says == "x" ? 1 : 0;
          }
        }
        cells.push_back(text);
      }
      rows.push_back(cells);
    }
    fmt::print("\n{}\n", names[m]);
    print_table({"error", "value", "deadbeat", "thesis", "constrained", "thesis", "classical", "thesis"},
                rows);
  }
  if (!published.empty()) {
    fmt::print(
        "\n{} cells as printed (=), {} between the least and the most of {} trails (~), {} neither (x).\n",
        equal, within, options.trails, outside);
  }
}

Table table_of(const sm::Trail& trail) {
  Table table;
  const auto add = [&](const std::string& name, const std::string& unit, double sm::TrailStep::*value) {
    Column column{name, unit, Eigen::VectorXd(static_cast<Eigen::Index>(trail.steps.size()))};
    for (std::size_t n = 0; n < trail.steps.size(); ++n) {
      column.values[static_cast<Eigen::Index>(n)] = trail.steps[n].*value;
    }
    table.columns.push_back(column);
  };
  add("x", "m", &sm::TrailStep::x);
  add("y", "m", &sm::TrailStep::y);
  add("apex", "m", &sm::TrailStep::apex);
  add("heading", "rad", &sm::TrailStep::heading);
  add("foot_x", "m", &sm::TrailStep::foot_x);
  add("foot_y", "m", &sm::TrailStep::foot_y);
  add("ground", "m", &sm::TrailStep::ground);
  add("wanted_deflection", "rad", &sm::TrailStep::wanted);
  add("apex_error", "m", &sm::TrailStep::apex_error);
  add("deflection_error", "rad", &sm::TrailStep::deflection_error);
  add("stumbling_margin", "m", &sm::TrailStep::stumbling_margin);
  return table;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out) {
    throw InputError({file.string(), 0, ""}, "a file that cannot be written", "a folder for the drawings");
  }
}

sm::LawKind law_named(const std::string& name) {
  for (const sm::LawKind kind : {sm::LawKind::deadbeat, sm::LawKind::constrained, sm::LawKind::classical}) {
    if (name == sm::to_string(kind)) {
      return kind;
    }
  }
  throw InputError({"", 0, "--law"}, "\"" + name + "\"",
                   "a law" + nearest_names(name, {"deadbeat", "constrained", "classical"}));
}

void run_trail_command(const Options& options, Outcome& outcome) {
  sm::TrailSettings settings;
  settings.law = law_named(options.law);
  settings.steps = options.steps;
  settings.seed = static_cast<std::uint64_t>(options.seed);
  check_new_folder(options.output);
  const sm::Behaviour behaviour = scanned(options);
  const sm::DeadbeatLaw law(behaviour, options.target);
  const sm::Tiles ground(1.0, 0.5 * options.tiles, settings.seed);
  const sm::Trail trail = sm::run_trail(law, ground, settings, true);
  double lowest = 0.0, highest = 0.0, margin = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < trail.steps.size(); ++n) {
    lowest = std::min(lowest, trail.steps[n].apex_error);
    highest = std::max(highest, trail.steps[n].apex_error);
    margin = n > 0 ? std::min(margin, trail.steps[n].stumbling_margin) : margin;
  }
  fmt::print("{} steps, {} way-points, ended: {}.\n", trail.steps.size(), trail.waypoints.size() - 1,
             trail.ending == sm::Ending::apex ? "all steps made" : sm::to_string(trail.ending));
  fmt::print(
      "Apex error {:.1f} to {:.1f} cm; deflection error at most {:.1f} deg; stumbling margin at least {:.1f} "
      "cm.\n",
      100.0 * lowest, 100.0 * highest, trail.worst_deflection() / degree, 100.0 * margin);
  if (!options.output.empty()) {
    const std::filesystem::path folder(options.output);
    std::filesystem::create_directories(folder);
    write_csv(table_of(trail), (folder / "steps.csv").string());
    write_text(folder / "from_above.svg", sm::seen_from_above(trail).svg());
    write_text(folder / "apex_error.svg", sm::apex_errors(trail).svg());
    write_text(folder / "deflection_error.svg", sm::deflection_errors(trail).svg());
    write_text(folder / "return_map.svg", sm::return_map(trail, options.target).svg());
    fmt::print("Written to {}: steps.csv and four drawings.\n", options.output);
  }
  outcome.status = trail.ending == sm::Ending::apex ? 0 : 1;
}

void add_scan_option(CLI::App& command, Options& options) {
  command.add_option("--scan", options.scan, "file that keeps the scan; made where it is missing")
      ->type_name("FILE");
  command.add_option("--target", options.target, "apex that the laws lead to, m")
      ->check(between(0.8, 2.2))
      ->capture_default_str();
}

}  // namespace

void add_spring_mass(CLI::App& app, Outcome& outcome) {
  CLI::App* group = app.add_subcommand(
      "spring-mass",
      "Spring-mass running: deadbeat leg placement in 3D, its sensitivity, and the theory of its errors");
  group->require_subcommand(1);
  auto options = std::make_shared<Options>();
  CLI::App* table =
      group->add_subcommand("table", "errors of three laws on disturbed models (Wu 2017, table 3.1)");
  add_scan_option(*table, *options);
  table->add_option("--reference", options->reference, "published numbers to hold against")->type_name("CSV");
  table->add_option("--trails", options->trails, "random trails for each cell")->check(CLI::Range(1, 1000));
  table->add_option("--steps", options->steps, "steps of a trail")->check(CLI::Range(50, 100000));
  table->footer("Example:\n  plumbline study spring-mass table --reference robots/atrias/wu_table_3_1.csv");
  table->callback([options] { run_table(*options); });
  CLI::App* trail = group->add_subcommand("trail", "one run from way-point to way-point over random tiles");
  add_scan_option(*trail, *options);
  trail->add_option("--law", options->law, "deadbeat, constrained (20 degrees a step) or classical")
      ->type_name("LAW");
  trail->add_option("--tiles", options->tiles, "highest tile above the lowest one, m; tiles of 1 m")
      ->check(between(0.0, 1.0))
      ->capture_default_str();
  trail->add_option("--steps", options->steps, "how many")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  trail->add_option("--seed", options->seed, "of way-points and tiles")->check(CLI::Range(0, 1000000000));
  trail->add_option("-o,--output", options->output, "folder for every step's numbers and four drawings")
      ->type_name("DIR");
  trail->footer("Example:\n  plumbline study spring-mass trail --seed 3 -o trail");
  trail->callback([options, &outcome] { run_trail_command(*options, outcome); });
  CLI::App* theory = group->add_subcommand(
      "theory", "how errors grow in stance and flight under feedback (Wu 2017, chapters 6 and 7)");
  theory->footer("Example:\n  plumbline study spring-mass theory");
  theory->callback([] { fmt::print("{}", sm::theory_report(sm::Gait{})); });
}

}  // namespace plumbline::cli
