// What was published about a robot, as data: numbers and curves with their source, and how they are measured
// here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "validation/control/gait/gait_run.h"
#include "validation/control/gait/return_map.h"

namespace plumbline::validation {

/// A published number.
struct PublishedQuantity {
  /// How the value binds: equal within the tolerance, or a limit.
  enum class Relation { value, at_most, at_least };
  std::string name;
  Measure measure;
  std::string unit;  ///< of the measure, SI
  Relation relation = Relation::value;
  model::Quantity quantity;   ///< SI; its unit is the file's
  model::Quantity tolerance;  ///< SI, >= 0; beyond a limit by less than this still holds
  int foot = -1;              ///< only cycles that this foot's touchdown began, index in Gait::feet; -1: all
  bool over_starts = false;   ///< of a run: over the random starts, not from the scenario's own
  std::string controller;     ///< file of other constants that this one is measured with; empty: the gait's

  /// By how much a measured value is outside the tolerance, SI, signed; 0 within it.
  double outside(double measured) const;
  /// How far it is from the value, or beyond the limit, in units of the tolerance (which must not be 0).
  double deviation(double measured) const;
};

std::string to_string(PublishedQuantity::Relation relation);

/// A published curve over a cycle: read off a figure, or given as data. Aligned by the event that begins a
/// cycle: the touchdown.
struct PublishedCurve {
  std::string name;
  std::string channel;
  std::string unit;           ///< as the file of the curve has it
  std::string file;           ///< CSV
  int foot = -1;              ///< as of PublishedQuantity
  bool over_shares = false;   ///< `at` are shares of the cycle; otherwise s since its beginning
  Eigen::VectorXd at, value;  ///< value: SI
  Eigen::VectorXd spread;     ///< standard deviation over the measured cycles, SI; empty: not published
  std::string source;         ///< paper, figure, page
  model::Quantity tolerance;  ///< of the root mean square difference, SI
};

/// One gait of a robot.
struct PublishedGait {
  std::string name;
  run::LoadedScenario loaded;
  Gait gait;
  std::optional<PoincareSection> section;
  std::vector<PublishedQuantity> quantities;
  std::vector<PublishedCurve> curves;
  Place_in_file where;
};

struct PublishedRobot {
  std::string file, title;
  std::vector<PublishedGait> gaits;
};

struct PublishedOptions {
  std::string gait;          ///< only this one; empty: all
  run::ScenarioFiles files;  ///< in place of what the scenario names
  std::string scenario;      ///< in place of the one that the file names (the robot at its boom)
};

/// Reads `plumbline: published/2` with the scenarios that it names. Throws InputError (one line: file, line,
/// key, found, expected).
PublishedRobot read_published(const std::string& path, const PublishedOptions& options = {});

}  // namespace plumbline::validation
