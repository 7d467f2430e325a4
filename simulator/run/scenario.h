// What is run: which robot under which controller, from where, over what, how long.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/terrain.h"
#include "simulator/model/model.h"
#include "simulator/model/yaml_node.h"
#include "simulator/run/controller_setup.h"
#include "simulator/run/ends.h"
#include "simulator/run/start.h"

namespace plumbline::run {

/// A number of the start that is drawn for random starts.
struct Drawn {
  enum class Of { position, velocity, clearance } of = Of::position;
  std::string name;             ///< of the position or velocity
  double from = 0.0, to = 0.0;  ///< SI, drawn evenly
  double times = 1.0;           ///< the position or velocity is the number drawn over this
  bool added = false;           ///< to what the start states; otherwise in its place
};

/// A number that measures know by name: times * x, or times * sin(x), of one position x. `divide_by` in the
/// file is 1/times.
struct Quantity {
  std::string name;
  std::string of;    ///< a coordinate, motor or joint
  std::string unit;  ///< SI
  bool sine = false;
  double times = 1.0;
  double value(const model::Plant& plant, const double* x) const;
};

struct Scenario {
  std::string file, title;
  std::string model;       ///< path
  std::string controller;  ///< path; empty: no motor is commanded
  double longest = 10.0;   ///< s
  contact::Terrain terrain;
  Start start;
  std::vector<Drawn> drawn;  ///< in the order in which they are drawn
  std::vector<Quantity> quantities;
  std::vector<End> ends;
};

/// Paths that take the place of those which the file names; empty: the file's.
struct ScenarioFiles {
  std::string model, controller;
};

/// A scenario's model is needed to read its numbers' units.
struct LoadedScenario {
  Scenario scenario;
  model::Model model;
  std::optional<ControllerSetup> controller;
};

/// Reads `plumbline: scenario/1`, its model and its controller. A file with a `base` states only what it
/// changes: whole sections, and single entries of start's positions and velocities. Throws InputError (one
/// line: file, line, key, found, expected).
LoadedScenario read_scenario(const std::string& path, const ScenarioFiles& in_place = {});

/// A section that others read ("gait"): the newest of the file and its bases.
std::optional<model::YamlNode> section_of_scenario(const std::string& path, const std::string& key);

/// Only what it says of its files: for those who want to know the model first.
ScenarioFiles files_of_scenario(const std::string& path);

}  // namespace plumbline::run
