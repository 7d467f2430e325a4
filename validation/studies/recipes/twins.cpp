#include "validation/studies/recipes/twins.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "validation/control/gait/gait_run.h"
#include "validation/identify/twin/recorded_run.h"
#include "validation/identify/twin/twin.h"
#include "validation/studies/recipes/linked.h"

namespace plumbline::validation {
namespace {

constexpr double kTolerance = 1e-8;  // of runs: errors far below any sensor's resolution
constexpr double kFarthest = 2.0;    // standard deviations of a draw

double drawn(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double number = normal(random);
  while (std::abs(number) > kFarthest) {
    number = normal(random);
  }
  return number;
}

/// Rows `first` to `first + count` of a table.
Table stretch_of(const Table& trace, Eigen::Index first, Eigen::Index count) {
  Table stretch = trace;
  for (Column& column : stretch.columns) {
    column.values = Eigen::VectorXd(column.values.segment(first, count));
  }
  return stretch;
}

/// The stretch of a run as a trial: what sensors read, what was commanded.
Trial trial_of(const run::LoadedScenario& loaded, const Table& record, const RunsMethod& runs,
               double period) {
  const auto first = static_cast<Eigen::Index>(std::lround(runs.from / period));
  const auto count = static_cast<Eigen::Index>(std::lround(runs.to / period)) - first;
  if (first + count > record.rows()) {
    throw std::runtime_error("the twin fell before the runs of the recipe were over");
  }
  return recorded_run(loaded.model, stretch_of(record, first, count), loaded.scenario);
}

std::vector<Trial> run_trials(const model::Model& robot, const RunsMethod& runs, std::uint64_t seed,
                              const StopFlag* stop) {
  run::LoadedScenario loaded = run::read_scenario(runs.scenario);
  loaded.model = robot;
  loaded.scenario.longest = runs.to + 0.01;
  std::vector<Trial> trials;
  std::mt19937_64 random(seed);
  for (const run::LoadedScenario& one : from_starts(loaded, runs.starts, seed)) {
    run::RunOptions options;
    options.trace = true;
    options.sensors.seed = random();
    options.integrator.set_tolerance(kTolerance);
    options.watch = [stop](const run::SampledRun&) {
      if (stop != nullptr && stop->raised) {
        throw Stopped();
      }
      return false;
    };
    const run::RunRecord record =
        run::run_scenario(one.model, one.scenario, one.controller ? &*one.controller : nullptr, options);
    const double period = one.controller ? one.controller->period : options.period;
    trials.push_back(trial_of(one, record.record, runs, period));
    trials.back().name = "run" + std::to_string(trials.size());
  }
  return trials;
}

}  // namespace

Truth draw_truth(const Recipe& recipe, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Truth truth;
  for (const Unknown& unknown : recipe.unknowns) {
    if (unknown.stated) {
      truth[unknown.name] = unknown.value + unknown.deviation * drawn(random);
    }
  }
  return truth;
}

std::vector<Trial> twin_trials(const Recipe& recipe, const Step& step, const Truth& truth, std::uint64_t seed,
                               const StopFlag* stop) {
  const model::Model robot = with_unknowns(recipe.model(step.robot), truth);
  if (step.runs) {
    return run_trials(robot, *step.runs, seed, stop);
  }
  std::vector<Trial> trials;
  TwinOptions options;
  options.seed = seed;
  for (const std::string& file : step.experiments) {
    trials.push_back(twin(robot, read_experiment(file, robot), options));
    trials.back().name = file;
    ++options.seed;  // each trial has its own noise
  }
  return trials;
}

PostureReadings twin_postures(const Recipe& recipe, const Step& step, const Truth& truth,
                              std::uint64_t seed) {
  const model::Model robot = with_unknowns(recipe.model(step.robot), truth);
  const Postures& postures = *step.postures;
  std::mt19937_64 random(seed);
  PostureReadings data;
  const auto poses = static_cast<Eigen::Index>(postures.poses.size());
  data.sensors.resize(static_cast<Eigen::Index>(robot.sensors.size()), poses);
  for (Eigen::Index i = 0; i < poses; ++i) {
    const Postures::Pose& pose = postures.poses[static_cast<std::size_t>(i)];
    Posture posture(robot, postures, pose, held_by_pose(robot, postures, pose));
    const double hand = postures.balanced.empty() ? 0.0 : postures.hand * drawn(random);
    const Eigen::VectorXd actual = posture.readings(hand);
    for (std::size_t s = 0; s < robot.sensors.size(); ++s) {
      const auto row = static_cast<Eigen::Index>(s);
      data.sensors(row, i) = sensor_reading(robot.sensors[s], actual[row], random);
    }
  }
  if (postures.scale_resolution > 0.0) {
    const double weight = total_weight(robot);
    const double shown = std::round(weight / postures.scale_resolution) * postures.scale_resolution;
    data.weight = Eigen::VectorXd::Constant(poses, shown);
  }
  return data;
}

}  // namespace plumbline::validation
