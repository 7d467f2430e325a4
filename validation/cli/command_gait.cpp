// A gait on its design model beside what was published of it.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "validation/cli/command_walking.h"
#include "validation/cli/commands.h"
#include "validation/cli/output.h"
#include "validation/studies/walking/rigid_gait.h"

namespace plumbline::cli {
namespace {

using validation::GaitControl;
using validation::RigidGait;
using validation::RigidGaitOptions;
using validation::RigidStep;
using validation::RigidWalker;

struct GaitArguments {
  std::string file, curves;
  bool scales = false, multipliers = false;
};

double cost_of_transport(const RigidGait& gait, const RigidStep& step) {
  return step.positive_work / (gait.mass * gait.model.skeleton.gravity.norm() * step.length);
}

std::string stated(const RigidGait& gait, const std::string& name, const char* format) {
  const auto found = gait.published.find(name);
  return found == gait.published.end() ? "" : fmt::format(fmt::runtime(format), found->second);
}

void print_step(const RigidGait& gait, const RigidStep& step) {
  print_table(
      {"quantity", "published", "here"},
      {{"step time (s)", stated(gait, "step_time", "{:.4f}"), fmt::format("{:.4f}", step.time)},
       {"step length (m)", stated(gait, "step_length", "{:.3f}"), fmt::format("{:.4f}", step.length)},
       {"speed (m/s)", stated(gait, "speed", "{:.2f}"), fmt::format("{:.4f}", step.length / step.time)},
       {fmt::format("cost of transport ({:.1f} kg)", gait.mass), stated(gait, "cost_of_transport", "{:.4f}"),
        fmt::format("{:.4f}", cost_of_transport(gait, step))},
       {"end of mc (s)", "", fmt::format("{:.4f}", step.phase_ends[0])},
       {"end of sc (s)", "", fmt::format("{:.4f}", step.phase_ends[1])},
       {"end of si (s)", "", fmt::format("{:.4f}", step.phase_ends[2])},
       {"impulse, forward and up (N s)", "",
        fmt::format("{:.2f}, {:.2f}", step.impulse.x(), step.impulse.z())},
       {"energy lost in the impact (J)", "", fmt::format("{:.3f}", step.impact_loss)},
       {"least normal force (N)", "", fmt::format("{:.1f}", step.least_normal)},
       {"largest friction over normal force", "", fmt::format("{:.3f}", step.largest_friction)}});
}

/// What a real floor would not do for a pinned toe.
void print_doubt(const RigidStep& step) {
  if (step.least_normal < 0.0) {
    fmt::print("\nThe pinned toe pulls at the ground with up to {:.1f} N: the robot would lift off.\n",
               -step.least_normal);
  }
}

/// Linear between rows; the step's own time runs from 0 to its end.
double at(const Eigen::VectorXd& t, const Eigen::VectorXd& values, double when) {
  const double* const after = std::upper_bound(t.data(), t.data() + t.size(), when);
  const Eigen::Index i = std::clamp<Eigen::Index>(after - t.data(), 1, t.size() - 1);
  const double span = t[i] - t[i - 1];
  const double w = span > 0.0 ? std::clamp((when - t[i - 1]) / span, 0.0, 1.0) : 1.0;
  return (1.0 - w) * values[i - 1] + w * values[i];
}

void print_curves(const RigidGait& gait, const RigidStep& step) {
  const Table published = read_csv(gait.curves);
  const Column* const when = published.find("t");
  const Column* const t = step.trace.find("t");
  std::vector<std::vector<std::string>> rows;
  for (const Column& column : published.columns) {
    const Column* const ours = step.trace.find(column.name);
    if (&column == when || when == nullptr || ours == nullptr) {
      continue;
    }
    const double factor = column.unit == "deg" ? 180.0 / M_PI : column.unit == "cm" ? 100.0 : 1.0;
    double sum = 0.0;
    double worst = 0.0;
    Eigen::Index counted = 0;
    for (Eigen::Index i = 0; i < published.rows() && when->values[i] <= step.time; ++i) {
      const double off = factor * at(t->values, ours->values, when->values[i]) - column.values[i];
      sum += off * off;
      worst = std::max(worst, std::abs(off));
      ++counted;
    }
    const double reach = column.values.maxCoeff() - column.values.minCoeff();
    rows.push_back({column.name, column.unit, fmt::format("{:.3g}", reach),
                    fmt::format("{:.3g}", std::sqrt(sum / static_cast<double>(counted))),
                    fmt::format("{:.3g}", worst)});
  }
  fmt::print("\n");
  print_table({"published curve", "unit", "its range", "rms difference", "largest"}, rows);
}

/// Steady speeds where velocities behind the impact are scaled: with the constraints kept, and under the
/// robot's own law.
void print_scales(const RigidGait& gait, RigidWalker& walker, const RigidWalker::FixedPoint& start) {
  std::vector<std::vector<std::string>> rows;
  Eigen::Vector3d guess = start.at;
  Eigen::VectorXd state = start.step.next;
  const auto speed = [](const RigidWalker::FixedPoint& point) {
    return point.found ? fmt::format("{:.3f}", point.step.length / point.step.time) : point.failure;
  };
  for (const RigidGait::ImpactScale& one : gait.impact_scales) {
    RigidGaitOptions options;
    options.impact_scale = one.scale;
    const RigidWalker::FixedPoint exact = walker.fixed_point(guess, options);
    options.control = GaitControl::feedforward;
    const RigidWalker::FixedPoint settled = walker.settle(state, options, 60, 1e-4);
    guess = exact.found ? exact.at : guess;
    state = settled.found ? settled.step.next : state;
    rows.push_back(
        {fmt::format("{:.3f}", one.scale), fmt::format("{:.2f}", one.speed), speed(exact), speed(settled)});
  }
  fmt::print("\n");
  print_table({"impact scale", "published speed (m/s)", "constraints kept", "feedforward and PD"}, rows);
}

void print_multipliers(const RigidGait& gait, RigidWalker& walker, const RigidStep& step) {
  fmt::print("\nMultipliers of the return map at the end of si (largest first)\n");
  RigidGaitOptions options;
  const auto show = [&](const char* what, const std::string& published, const Eigen::VectorXd& values) {
    fmt::print("  {}: published {}, here", what, published.empty() ? "none" : published);
    for (Eigen::Index i = 0; i < 4; ++i) {
      fmt::print(" {:.4f}", values[i]);
    }
    fmt::print("\n");
  };
  show("constraints kept", stated(gait, "multiplier_exact", "{:.4f}"),
       walker.multipliers(step.next, options));
  options.control = GaitControl::feedforward;
  const RigidWalker::FixedPoint settled = walker.settle(step.next, options, 80, 1e-5);
  if (!settled.found) {
    fmt::print("  feedforward and PD: {}\n", settled.failure);
    return;
  }
  show("feedforward and PD", stated(gait, "multiplier_feedforward", "{:.4f}"),
       walker.multipliers(settled.step.next, options));
  fmt::print("  its step: {:.4f} s, {:.4f} m, {:.4f} m/s, cost of transport {:.4f}\n", settled.step.time,
             settled.step.length, settled.step.length / settled.step.time,
             cost_of_transport(gait, settled.step));
}

void run(const GaitArguments& arguments, Outcome& outcome) {
  const RigidGait gait = validation::read_rigid_gait(arguments.file);
  RigidWalker walker(gait);
  RigidGaitOptions options;
  const Eigen::Vector3d guess(gait.start.at("theta_rate"), gait.start.at("spring"),
                              gait.start.at("spring_rate"));
  RigidWalker::FixedPoint point = walker.fixed_point(guess, options);
  if (!point.found) {
    fmt::print("No step that repeats was found: {}\n", point.failure);
    outcome.status = 1;
    return;
  }
  options.trace = true;
  const RigidStep step = walker.step(walker.after_touchdown(point.at, options.impact_scale), options);
  print_step(gait, step);
  print_doubt(step);
  if (!gait.curves.empty()) {
    print_curves(gait, step);
  }
  if (arguments.scales) {
    print_scales(gait, walker, point);
  }
  if (arguments.multipliers) {
    print_multipliers(gait, walker, step);
  }
  if (!arguments.curves.empty()) {
    write_csv(step.trace, arguments.curves);
  }
}

}  // namespace

void add_gait(CLI::App& app, Outcome& outcome) {
  auto arguments = std::make_shared<GaitArguments>();
  CLI::App* const command =
      app.add_subcommand("gait", "find a gait's step on its design model, beside what was published");
  command->add_option("file", arguments->file, "a rigid_gait file")->required();
  command->add_flag("--impact-scales", arguments->scales, "steady speeds where the impact is scaled");
  command->add_flag("--multipliers", arguments->multipliers, "how deviations grow from step to step");
  command->add_option("-o,--curves", arguments->curves, "write the step's curves (CSV)");
  command->callback([arguments, &outcome]() { run(*arguments, outcome); });
}

}  // namespace plumbline::cli
