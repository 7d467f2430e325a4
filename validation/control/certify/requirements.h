// What a controller has to show before it may drive a robot: `plumbline: requirements/1`.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "controllers/driver/plan.h"
#include "simulator/model/yaml_node.h"
#include "simulator/run/scenario.h"
#include "simulator/trace/error.h"
#include "validation/control/gait/measure.h"

namespace plumbline::validation {

/// A number measured on the gait's settled cycles, as a mean over all of them, and where it must lie. SI.
struct RequiredQuantity {
  std::string name;
  Measure measure;
  double from = -driver::kNone, to = driver::kNone;
  std::string unit;     ///< as written, for people
  double factor = 1.0;  ///< SI per unit
  std::string source;   ///< of the number
  int foot = -1;        ///< only cycles that this foot's touchdown began, index in Gait::feet; -1: all
};

/// Quantities of a file of published numbers: value and tolerance stand there, once.
struct RequiredPublished {
  std::string file, gait;
  std::vector<std::string> names;
  Place_in_file where;
};

/// So many runs, of which a share must last.
struct RequiredShare {
  int runs = 0;
  double at_least = 1.0;
  std::string why;
};

/// Samples on their way to the controller and commands on theirs to the robot. Shares of all samples, each
/// drawn by itself. A duplicated sample changes nothing: the driver takes each number once. A late one is a
/// lost one: the driver has gone on.
struct RequiredWire : RequiredShare {
  double lost = 0.0;  ///< the controller does not step, the command before holds
  double late = 0.0;  ///< the command acts one sample later
};

/// Level steps in the ground, each so long, up or down by up to so much, drawn evenly; level where the robot
/// begins.
struct RequiredTerrain : RequiredShare {
  double length = 1.0, height = 0.0;  ///< m
  double level = 0.5;                 ///< m to either side of the start
};

struct Requirements {
  std::string file, title;
  std::string scenario;  ///< path
  std::string valid_until;
  std::uint64_t seed = 1;
  long cycles = 40;                    ///< that a run must make to have lasted
  std::vector<std::string> reference;  ///< files whose numbers are required: their hashes are signed too

  std::vector<RequiredPublished> published;
  std::vector<RequiredQuantity> quantities;  ///< the file's own; add_published() puts the others behind them
  RequiredShare starts;
  std::optional<RequiredShare> robots;
  double robots_share = 0.0;  ///< of draw_models(); 0: by the uncertainties that the model states
  std::optional<RequiredShare> noise;
  double noise_counts = 0.0;  ///< standard deviation, counts of each sensor, beside the model's own
  std::optional<RequiredWire> wire;
  std::optional<RequiredTerrain> terrain;
  std::optional<double> multiplier;        ///< largest of the gait's orbit
  std::optional<double> command_margin;    ///< share of each command's limit that no run may use
  std::optional<double> workspace_margin;  ///< share of each reach's range, at either end
  std::optional<double> step_time;         ///< s, 99.9 % of the controller's steps
  bool no_allocation = false;              ///< none in 20,000 steps

  /// What goes to the driver as it is, and by how much the largest rate, the longest rest and the largest
  /// change of a command of all lasting runs are stretched to become its limits.
  driver::Plan drive;
  double speed_times = 2.0, rest_times = 3.0, slew_times = 2.0;
};

/// Paths in the file are relative to it. A file with a `base` states only what it changes of that file, whole
/// sections. Throws InputError (one line).
Requirements read_requirements(const std::string& path);

/// Reads the published quantities on the requirements' scenario; their files become reference data. Throws
/// InputError for a name that the gait does not have, or one that is no mean over cycles.
void add_published(Requirements& requirements);

/// The drive section's names are checked against the model; its channels and commands are filled from there.
/// Throws InputError.
void complete_drive(Requirements& requirements, const run::LoadedScenario& loaded);

}  // namespace plumbline::validation
