#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "validation/cli/commands.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/report/result_json.h"

namespace plumbline::cli {
namespace {

using validation::ChannelError;
using validation::Comparison;
using validation::PhaseError;
using validation::WindowError;

/// The channel of a trial that is farthest from its floor.
std::string worst_channel(const Comparison& comparison, const std::string& trial) {
  const ChannelError* worst = nullptr;
  for (const ChannelError& c : comparison.channels) {
    const bool has_phases = std::any_of(comparison.phases.begin(), comparison.phases.end(),
                                        [&](const PhaseError& p) { return p.channel == c.name; });
    if (c.trial == trial && has_phases && (worst == nullptr || c.ratio > worst->ratio)) {
      worst = &c;
    }
  }
  return worst == nullptr ? "" : worst->name;
}

/// One line for each group of phases, of each trial's worst channel.
void print_phases(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const PhaseError& p : comparison.phases) {
    if (p.channel != worst_channel(comparison, p.trial)) {
      continue;
    }
    const std::string one = fmt::format("{} {:.2f}", p.phase.name, p.ratio);
    const bool same = !rows.empty() && rows.back()[0] == p.trial && rows.back()[2] == p.phase.group;
    if (same) {
      rows.back()[3] += ", " + one;
    } else {
      rows.push_back({p.trial, p.channel, p.phase.group, one});
    }
  }
  fmt::print("\nWhere in the motion, for the worst channel of each trial (rms/floor by phase):\n\n");
  print_table({"trial", "channel", "phases by", "rms/floor"}, rows);
}

std::string horizon_text(const validation::HorizonError& error) {
  return std::isfinite(error.rms) ? fmt::format("{:.3g}", error.rms) : "lost";
}

/// One row for each channel, one column for each horizon that any of them reaches.
void print_horizons(const std::vector<validation::HorizonError>& errors) {
  std::vector<std::string> head{"trial", "role", "channel", "unit"};
  std::vector<double> horizons;
  for (const double horizon : validation::usual_horizons()) {
    const bool any = std::any_of(errors.begin(), errors.end(),
                                 [&](const validation::HorizonError& e) { return e.horizon == horizon; });
    if (any) {
      horizons.push_back(horizon);
      head.push_back(fmt::format("{:g} s", horizon));
    }
  }
  std::vector<std::vector<std::string>> rows;
  for (const validation::HorizonError& e : errors) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const std::vector<std::string>& one) {
      return one[0] == e.trial && one[2] == e.channel;
    });
    if (row == rows.end()) {
      rows.push_back({e.trial, to_string(e.role), e.channel, e.unit});
      rows.back().resize(head.size(), "-");
      row = rows.end() - 1;
    }
    const auto at = std::find(horizons.begin(), horizons.end(), e.horizon) - horizons.begin();
    (*row)[4 + static_cast<std::size_t>(at)] = horizon_text(e);
  }
  if (!horizons.empty()) {
    fmt::print(
        "\nError over the prediction horizon: rms so long after the last measurement that the prediction "
        "knows:\n\n");
    print_table(head, rows);
  }
}

/// A switch that is off by the same at every landing.
void print_switches(const std::vector<validation::SwitchTiming>& switches) {
  std::vector<std::vector<std::string>> rows;
  for (const validation::SwitchTiming& one : switches) {
    if (one.is_steady()) {
      rows.push_back({one.trial, one.name, one.closes ? "closes" : "opens",
                      fmt::format("{:+.2f} +- {:.2f} ms", 1e3 * one.mean, 1e3 * one.scatter),
                      fmt::format("{} of {}", one.count, one.closes ? "touchdowns" : "lift-offs")});
    }
  }
  if (!rows.empty()) {
    fmt::print(
        "\nContact switches that read late (early: below zero) by the same each time. Then the switch is "
        "late or closes at a force, rather than the ground wrong (`switch_lateness`, docs/logs.md):\n\n");
    print_table({"trial", "switch", "", "read less predicted", "mean"}, rows);
  }
}

/// "velocity jumps by -0.8 m/s (-5 N s)".
std::string jump_text(const validation::Defect& one) {
  if (!one.is_speed) {
    return fmt::format("position jumps by {:+.3g} {}", one.jump, one.unit);
  }
  const bool angular = one.unit == "rad/s";
  return fmt::format("velocity jumps by {:+.3g} {} ({:+.3g} {})", one.jump, one.unit, one.impulse,
                     angular ? "N m s" : "N s");
}

void print_defects(const std::vector<validation::Defect>& defects) {
  constexpr std::size_t kShown = 8;
  if (defects.empty()) {
    return;
  }
  fmt::print(
      "\nWhere something happens that the model does not know: between segments of an eighth of a window, "
      "each "
      "predicted\nfrom its own start ({} of more than four deviations):\n\n",
      defects.size());
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < std::min(kShown, defects.size()); ++i) {
    const validation::Defect& one = defects[i];
    rows.push_back({one.trial, fmt::format("{:.3f} s", one.time), one.at, jump_text(one),
                    fmt::format("{:.1f}", one.deviations)});
  }
  print_table({"trial", "time", "at", "", "deviations"}, rows);
}

/// What is in none of the errors.
void print_lost(const std::vector<validation::LostWindow>& lost) {
  constexpr std::size_t kShown = 5;
  if (lost.empty()) {
    return;
  }
  fmt::print("\nLeft out, because the model cannot be integrated there ({} windows):\n\n", lost.size());
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < std::min(kShown, lost.size()); ++i) {
    rows.push_back(
        {lost[i].trial, fmt::format("{:.2f} to {:.2f} s", lost[i].from, lost[i].to), lost[i].reason});
  }
  print_table({"trial", "window", "because"}, rows);
}

void print(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const ChannelError& c : comparison.channels) {
    rows.push_back({c.trial, to_string(c.role), c.name, fmt::format("{:.4g} {}", c.rms, c.unit),
                    fmt::format("{:.3g} {}", c.floor, c.unit), fmt::format("{:.2f}", c.ratio)});
  }
  fmt::print("Residual of each channel, predicted in windows from their own start:\n\n");
  print_table({"trial", "role", "channel", "rms", "floor", "rms/floor"}, rows);
  fmt::print("\nWorst windows:\n\n");
  rows.clear();
  for (std::size_t i = 0; i < std::min<std::size_t>(5, comparison.windows.size()); ++i) {
    const WindowError& w = comparison.windows[i];
    rows.push_back({w.trial, fmt::format("{:.2f} to {:.2f} s", w.from, w.to), fmt::format("{:.2f}", w.ratio),
                    w.worst_channel});
  }
  print_table({"trial", "window", "error/floor", "worst channel"}, rows);
  print_phases(comparison);
  print_horizons(comparison.horizons);
  print_switches(comparison.switches);
  print_defects(comparison.defects);
  print_lost(comparison.lost);
  fmt::print(
      "\nError in units of the floor (1: what the sensors alone leave): train {:.3f}, held-out {:.3f}\n",
      comparison.scores.train, comparison.scores.held_out);
  if (comparison.scores.test > 0.0) {
    fmt::print("On the trials of role test, which neither fit nor choose: {:.3f}\n", comparison.scores.test);
  }
}

}  // namespace

void add_compare(CLI::App& app, Outcome& /*outcome*/) {
  auto inputs = std::make_shared<Inputs>();
  CLI::App* command = app.add_subcommand("compare", "Where the model fails: per channel and time window");
  add_trial_inputs(*command, *inputs);
  command->footer(
      "Example:\n  plumbline compare demo/siso_mLA demo/mimo --model robots/mabel/leg_bench.yaml");
  command->callback([inputs] {
    const Loaded loaded = load(*inputs);
    const Comparison comparison = validation::compare_with_curves(loaded.model, *loaded.data);
    write_json(to_json(comparison), inputs->json);
    print(comparison);
  });
}

}  // namespace plumbline::cli
