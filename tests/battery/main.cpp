// The long trial of the diagnosis: effects are hidden in synthetic measurements, and it must name them.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>

#include "tests/battery/report.h"
#include "tests/battery/result_json.h"
#include "tests/battery/results_file.h"
#include "tests/battery/sweep.h"
#include "work/workers.h"

namespace plumbline::battery {
namespace {

struct Inputs {
  RunOptions run;
  std::vector<std::string> only;
  std::size_t subset = 0;
  std::vector<std::string> rigs{"all"};
  bool list = false;
  bool explain = false;
  bool score = false;
  bool sweep = false;
  bool take_away = false;
  Measured measured;
  std::string results, json, csv;
  std::vector<std::string> durations;
};

bool is_asked_for(const Case& one, const Inputs& inputs) {
  const bool of_rigs = std::any_of(inputs.rigs.begin(), inputs.rigs.end(), [&](const std::string& rig) {
    const std::vector<std::string> robots = robots_of_rig(rig);
    return std::find(robots.begin(), robots.end(), one.robot) != robots.end();
  });
  return of_rigs && (inputs.only.empty() ||
                     std::any_of(inputs.only.begin(), inputs.only.end(), [&](const std::string& word) {
                       return one.name.find(word) != std::string::npos;
                     }));
}

/// Cases of the rigs that the world can play, whose name contains one of the words; all when there are none.
/// Fills in why the others of them cannot be played, each reason once.
std::vector<Case> chosen(const Inputs& inputs, std::set<std::string>& reasons) {
  std::vector<Case> cases;
  for (const Case& one : all_cases()) {
    if (!is_asked_for(one, inputs)) {
      continue;
    }
    const std::string reason = why_not(one, inputs.run.world);
    if (reason.empty()) {
      cases.push_back(one);
    } else {
      reasons.insert(reason);
    }
  }
  return cases;
}

/// `count` of the cases, drawn with the seed, in the order of the tables.
std::vector<Case> subset(const std::vector<Case>& cases, std::size_t count, std::uint64_t seed) {
  if (count == 0 || count >= cases.size()) {
    return cases;
  }
  std::vector<std::size_t> order(cases.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(order[i], order[i + random() % (order.size() - i)]);
  }
  order.resize(count);
  std::sort(order.begin(), order.end());
  std::vector<Case> some;
  some.reserve(count);
  for (const std::size_t i : order) {
    some.push_back(cases[i]);
  }
  return some;
}

void show_bare(const Result& result) {
  fmt::print("{:<44} {:>8.2f}  {}\n", result.one.name, result.bare,
             result.error.empty() ? result.with : result.error);
}

void show(const Result& result, const Inputs& inputs) {
  inputs.run.bare_only || !inputs.run.write.empty() ? show_bare(result)
                                                    : fmt::print("{}\n", table_line(result));
  if (inputs.explain) {
    fmt::print("{}", explanation(result));
  }
  std::fflush(stdout);
}

/// Each case by one of the ranks. What they tell of candidates (--explain) stays where it was found.
std::vector<Result> results_of_ranks(const std::vector<Case>& cases, const Inputs& inputs,
                                     work::Workers& workers, ResultsFile* file) {
  work::Durations durations;
  for (const std::string& results : inputs.durations) {
    add_durations(results, durations);
  }
  std::vector<work::Task> tasks;
  for (const Case& one : cases) {
    tasks.push_back(
        {one.name, [&] { return to_json(run_case(one, inputs.run)).dump(); }, durations.of(one.name)});
  }
  work::Watch watch;
  watch.known = [&](std::size_t c) {
    const Result* known = file != nullptr ? file->find(cases[c].name) : nullptr;
    return known != nullptr ? std::optional<std::string>(to_json(*known).dump()) : std::nullopt;
  };
  watch.done = [&](std::size_t /*c*/, const std::string& result, double /*seconds*/) {
    const Result one = result_from(nlohmann::json::parse(result));
    if (file != nullptr) {
      file->add(one);
    }
    show(one, inputs);
  };
  std::vector<Result> results;
  for (const std::string& result : workers.run(tasks, watch).bytes) {
    results.push_back(result_from(nlohmann::json::parse(result)));
  }
  return results;
}

/// Those in the results' file are not run again; with --score, no others are looked at.
std::vector<Result> results_of(const std::vector<Case>& cases, const Inputs& inputs, work::Workers& workers) {
  std::optional<ResultsFile> file;
  if (!inputs.results.empty() && workers.is_first()) {
    if (inputs.score && !std::filesystem::exists(inputs.results)) {
      throw std::runtime_error(inputs.results + ": no such file");
    }
    file.emplace(inputs.results, inputs.run);
  }
  if (workers.ranks() > 1 && !inputs.score) {
    return results_of_ranks(cases, inputs, workers, file ? &*file : nullptr);
  }
  std::vector<Result> results;
  for (const Case& one : cases) {
    const Result* known = file ? file->find(one.name) : nullptr;
    if (known == nullptr && inputs.score) {
      continue;
    }
    results.push_back(known != nullptr ? *known : run_case(one, inputs.run));
    if (file && known == nullptr) {
      file->add(results.back());
    }
    show(results.back(), inputs);
  }
  return results;
}

int sweep_policy(const std::vector<Case>& cases, const Inputs& inputs) {
  std::vector<Diagnose> all;
  if (!inputs.measured.trials.empty()) {
    all.emplace_back([&](const RunOptions& run) { return run_measured(inputs.measured, run); });
  } else {
    for (const Case& one : cases) {
      all.emplace_back([&one](const RunOptions& run) { return run_case(one, run); });
    }
  }
  fmt::print("{}",
             sweep_text(inputs.sweep ? sweep(all, inputs.run) : take_away(all, inputs.run), all.size()));
  return 0;
}

int run(const Inputs& inputs, work::Workers& workers) {
  std::set<std::string> reasons;
  const std::vector<Case> cases = subset(chosen(inputs, reasons), inputs.subset, inputs.run.seed);
  if (cases.empty()) {
    for (const std::string& reason : reasons) {
      fmt::print(stderr, "battery: {}\n", reason);
    }
    fmt::print(stderr, "battery: no case has such a name (--list shows all)\n");
    return 2;
  }
  if (!workers.is_first() && (inputs.list || inputs.sweep || inputs.take_away || inputs.score)) {
    return 0;
  }
  if (inputs.list) {
    for (const Case& one : cases) {
      fmt::print("{}\n", one.name);
    }
    return 0;
  }
  if (inputs.sweep || inputs.take_away) {
    return sweep_policy(cases, inputs);
  }
  if (!inputs.run.bare_only && inputs.run.write.empty()) {
    fmt::print("{}\n", table_head());
  }
  const std::vector<Result> results = results_of(cases, inputs, workers);
  if (!workers.is_first()) {
    return 0;
  }
  const Targets targets;
  const Summary summary = summarise(results, targets);
  if (!inputs.json.empty()) {
    write_json(inputs.json, results, summary, targets, inputs.run.seed);
  }
  if (!inputs.csv.empty()) {
    write_csv(inputs.csv, results);
  }
  if (inputs.run.bare_only || !inputs.run.write.empty()) {
    return summary.errors == 0 ? 0 : 1;
  }
  fmt::print("\n{}\n{}", confusion_text(results), summary_text(summary, targets));
  return targets_met(summary, targets) ? 0 : 1;
}

}  // namespace
}  // namespace plumbline::battery

int main(int argc, char** argv) {
  plumbline::battery::Inputs inputs;
  CLI::App app{
      "Hides effects in synthetic measurements and looks whether the diagnosis names them.\n"
      "Exit status: 0 all targets met, 1 a target missed, 2 bad input.",
      "battery"};
  app.add_option("--seed", inputs.run.seed, "seed of the drawn parameters")->capture_default_str();
  app.add_option("--only", inputs.only, "only cases whose name contains SUBSTRING; may be repeated")
      ->type_name("SUBSTRING")
      ->allow_extra_args(false);
  app.add_option("--rig", inputs.rigs,
                 "bench, pendulum, hopper, mabel, sealed (for releases only) or all but the last two; may be "
                 "repeated")
      ->type_name("RIG")
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("--subset", inputs.subset, "only K cases, drawn with the seed")->type_name("K");
  app.add_option("--json", inputs.json, "write everything to FILE")->type_name("FILE");
  app.add_option("--csv", inputs.csv, "write one line per case to FILE")->type_name("FILE");
  app.add_option("--results", inputs.results,
                 "keep every result in FILE as it comes, and do not run again what stands there")
      ->type_name("FILE")
      ->excludes(
          app.add_flag("--bare", inputs.run.bare_only, "no diagnosis: only the error of the model as it is"));
  app.add_option("--durations", inputs.durations,
                 "on several ranks: results of an earlier run, whose longest cases are begun first; may be "
                 "repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_flag("--score", inputs.score, "run nothing: the scoreboard of what stands in the results' file")
      ->needs("--results");
  app.add_flag(
      "--as-stated", inputs.run.as_stated,
      "the robot's own numbers exactly those of the model, not scattered within what is stated of them");
  app.add_option("--world", inputs.run.world,
                 "who makes the data: own (the simulator under test), lagrangian (equations by hand, fixed "
                 "steps, own "
                 "friction and contact) or mujoco")
      ->type_name("WORLD")
      ->transform(CLI::CheckedTransformer(std::map<std::string, plumbline::battery::World>{
          {"own", plumbline::battery::World::own},
          {"lagrangian", plumbline::battery::World::lagrangian},
          {"mujoco", plumbline::battery::World::mujoco}}));
  CLI::Option* lab = app.add_flag(
      "--lab", inputs.run.lab,
      "foreign worlds: ratios, centres of mass, lengths, sensors' zeros and delays scattered as a laboratory "
      "would know them, and unusual constants of shape");
  app.add_flag("--tolerances", inputs.run.tolerances,
               "with --lab: the model that is diagnosed states how well these numbers are known")
      ->needs(lab);
  app.add_flag("--explain", inputs.explain, "below each case: the candidates and why they were not accepted");
  CLI::Option* sweep =
      app.add_flag("--sweep", inputs.sweep,
                   "diagnose each case again with half and twice the value of every constant of the policy");
  CLI::Option* take_away =
      app.add_flag("--take-away", inputs.take_away,
                   "diagnose each case again with every constant of the policy taken away in turn")
          ->excludes(sweep);
  app.add_option("--measured", inputs.measured.trials,
                 "in place of the cases: these trials of a real machine; with --take-away")
      ->type_name("TRIAL")
      ->needs(take_away);
  app.add_option("--data", inputs.measured.data_folder, "where their recordings are")->type_name("DIR");
  app.add_flag("--timing", inputs.run.timing, "what each diagnosis does, and when, to the standard error");
  app.add_option("--write", inputs.run.write,
                 "diagnose nothing: write the trials of each case into a folder of its own below DIR")
      ->type_name("DIR");
  app.add_flag("--list", inputs.list, "only the names of the cases");
  std::unique_ptr<plumbline::work::Workers> workers;
  int status = 2;
  try {
    const char* times = std::getenv("PLUMBLINE_WORK_TIMES");
    workers = plumbline::work::start(times == nullptr ? "" : times);
    if (!workers->is_first() && std::freopen("/dev/null", "w", stdout) == nullptr) {
      return 2;
    }
    app.parse(argc, argv);
    status = plumbline::battery::run(inputs, *workers);
  } catch (const CLI::ParseError& error) {
    status = app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "battery: {}\n", error.what());
    if (workers) {
      workers->fail(error.what());
    }
  }
  std::fflush(stdout);
  return workers ? workers->finish(status) : status;
}
