#include "validation/recipes/twins.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "validation/hopping/hop_statistics.h"
#include "validation/hopping/hopping_file.h"
#include "validation/hopping/recorded_trial.h"
#include "validation/recipes/linked.h"
#include "validation/twin/twin.h"

namespace plumbline::validation {
namespace {

constexpr double kTolerance = 1e-8;  // of hops: errors far below any sensor's resolution
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

/// The stretch of a hopping run as a trial: what sensors read, what was commanded.
Trial trial_of(const model::Model& robot, const Table& trace, const HopsMethod& hops, double period,
               std::uint64_t seed) {
  const auto first = static_cast<Eigen::Index>(std::lround(hops.from / period));
  const auto count = static_cast<Eigen::Index>(std::lround(hops.to / period)) - first;
  if (first + count > trace.rows()) {
    throw std::runtime_error("the twin fell before the hops of the recipe were over");
  }
  Trial trial = recorded_trial(robot, stretch_of(trace, first, count), seed);
  trial.name = "hops";
  return trial;
}

std::vector<Trial> hop_trials(const model::Model& robot, const HopsMethod& hops, std::uint64_t seed,
                              const StopFlag* stop) {
  const controllers::HoppingConfig config = read_hopping(hops.controller);
  HopOptions options;
  options.trace = true;
  options.stop = stop;
  options.longest = hops.to + 0.01;
  options.integrator.set_tolerance(kTolerance);
  std::mt19937_64 random(seed);
  std::vector<Trial> trials;
  for (const HopRun& run : hop_from(robot, config, draw_starts(hops.starts, seed), options)) {
    trials.push_back(trial_of(robot, run.trace, hops, config.period, random()));
    trials.back().name += std::to_string(trials.size());
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
  if (step.hops) {
    return hop_trials(robot, *step.hops, seed, stop);
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
