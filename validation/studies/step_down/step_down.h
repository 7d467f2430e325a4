// A walking robot on ground that falls once.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/control/gait/gait_run.h"
#include "validation/studies/walking/rigid_gait.h"

namespace plumbline::validation {

/// What was published of one height. Impulses in N s.
struct PublishedStepDown {
  double height = 0.0;  ///< m, by which the ground falls
  bool passed = false;
  std::optional<double> first, second;  ///< vertical contact intensity on the lower ground
  std::string source;
};

/// `plumbline: step_down/1`.
struct StepDownTest {
  std::string file, title;
  run::LoadedScenario scenario;  ///< of walking; its terrain is replaced
  Gait gait;
  RigidGait design;             ///< whose impact map gives contact intensities
  double edge = 0.0;            ///< where the ground falls, along x, m
  long enough = 12;             ///< touchdowns on the lower ground that count as passed
  double fuse = 0.0;            ///< vertical contact intensity at which the shin's fuse breaks, N s
  double force_time = 0.0;      ///< behind a touchdown, over which the simulated force is summed up, s
  std::vector<double> heights;  ///< by which the ground falls, m
  struct Controller {
    std::string name;
    run::ControllerSetup setup;
  };
  std::vector<Controller> controllers;
  std::vector<PublishedStepDown> published;
  double flat = 0.0, flat_deviation = 0.0;  ///< published vertical contact intensity on level ground, N s
};
/// Throws InputError.
StepDownTest read_step_down(const std::string& path);

/// How one foot came down.
struct Touchdown {
  double time = 0.0;                                  ///< s
  bool lower = false;                                 ///< behind the edge
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  ///< by the impact map, N s
  double force_impulse = 0.0;                         ///< integral of the simulated vertical force, N s
  double speed = 0.0;                                 ///< of the hip, m/s
};

struct StepDownRun {
  enum class Outcome { passed, fell, broke, not_reached } outcome = Outcome::not_reached;
  std::string end;  ///< in words
  std::vector<Touchdown> touchdowns;
  double lowest_torso = 0.0, highest_torso = 0.0;  ///< on the lower ground, rad
  /// The n-th touchdown on the lower ground (1: the step down); nullptr where there was none.
  const Touchdown* behind_edge(int n) const;
};

/// One run from the scenario's start over ground that falls by `height`.
StepDownRun step_down(const StepDownTest& test, const run::LoadedScenario& scenario, double height,
                      const StopFlag* stop);

/// One cell of the table: a controller and a height from several starts.
struct StepDownShare {
  std::string controller;
  double height = 0.0;
  std::vector<StepDownRun> runs;
  int count(StepDownRun::Outcome outcome) const;
};

struct StepDownOptions {
  int starts = 1;  ///< 1: the scenario's own; more: drawn from its ranges
  std::uint64_t seed = 1;
  const StopFlag* stop = nullptr;
  work::Workers* workers = nullptr;  ///< of several ranks: each run by one of them
};
/// All controllers at all heights, on all cores or among the ranks. Progress is told how many runs of how
/// many are done.
std::vector<StepDownShare> step_down_all(const StepDownTest& test, const StepDownOptions& options,
                                         const std::function<void(double)>& progress);

}  // namespace plumbline::validation
