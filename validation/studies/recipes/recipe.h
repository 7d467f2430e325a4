// An identification sequence as data: which experiments, which parameters, in which order, and what is
// carried on.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {

/// How near a recovered value must come to the true one.
struct Target {
  double size = 0.0;
  bool relative = false;  ///< size is a share of the true value
};

/// What is to be found: a number of the robot that several models may share.
struct Unknown {
  std::string name, title, unit;
  bool stated = false;  ///< `value` and `deviation` are given
  double value = 0.0;   ///< SI
  double deviation =
      0.0;  ///< one standard deviation of what is known before any experiment, SI; 0: not uncertain
  std::optional<Target> target;
};

/// parameter = times * unknown^power + plus
struct Link {
  std::string label;  ///< "viscous@mLA:damping"
  std::string unknown;
  double times = 1.0, plus = 0.0;
  int power = 1;  ///< 1 or -1
  Place_in_file place;

  double parameter(double unknown_value) const;
  double unknown_of(double parameter_value) const;
  double slope(double unknown_value) const;  ///< d(parameter)/d(unknown)
};

/// A model file, and which of its parameters are which unknowns.
struct LinkedModel {
  std::string name, file;
  model::Model model;
  std::vector<Link> links;
};

/// Equations S1, S2: bias, inertia and friction of one motor that turns freely.
struct ArxMethod {
  std::string motor, sensor;
  std::string bias, inertia, friction;  ///< unknowns; empty: not wanted
};

/// Equation 14: torque and rotor factors from lumped inertias.
struct Equation14Method {
  struct Row {
    std::string lumped;    ///< unknown that an earlier step has estimated
    double pulleys = 0.0;  ///< kg m^2
  };
  double rotor_inertia = 0.0;  ///< the manufacturer's, kg m^2
  std::vector<Row> rows;
  std::string torque_factor, rotor_factor;
};

/// Static postures: a pose, what is held there, and what is read.
struct Postures {
  struct Pose {
    std::vector<std::pair<std::string, double>> at;  ///< coordinates, SI
  };
  std::vector<std::string> locked;
  std::string balanced;           ///< coordinate that a hand balances; empty: none
  double hand = 0.0;              ///< one standard deviation of its error, SI
  double scale_resolution = 0.0;  ///< of the scale under the foot, N; 0: no scale
  std::vector<Pose> poses;
};

/// Equation 22 with a preload as in Figure 17: stiffness of B_Spring from balanced postures.
struct Equation22Method {
  std::string knee, spring;        ///< sensors
  double ratio = 0.0;              ///< 5.18
  std::string stiffness, preload;  ///< unknowns
};

/// A scenario's controller on the robot in place of recorded commands: short runs from drawn starts.
struct RunsMethod {
  std::string scenario;         ///< file
  int starts = 1;               ///< runs, one trial each
  double from = 0.0, to = 0.0;  ///< the stretch of each run that is used, s
};

struct Step {
  std::string name, title, source;
  std::string method;  ///< window_fit, information, posture_fit, arx, equation_14, equation_22
  std::string model;   ///< name of a linked model; empty for equation_14
  std::string robot;   ///< the linked model that plays the robot in twins
  std::vector<std::string> experiments, trials;
  std::string data_of;  ///< an earlier step whose data this one uses
  std::vector<std::string> free, known;
  double window = 0.5;  ///< s
  bool carried = true;  ///< false: for comparison only
  ArxMethod arx;
  Equation14Method equation_14;
  Equation22Method equation_22;
  std::optional<Postures> postures;
  std::optional<RunsMethod> runs;
  Place_in_file place;
};

struct Recipe {
  std::string file, title;
  std::vector<Unknown> unknowns;
  std::vector<LinkedModel> models;
  std::vector<Step> steps;

  const Unknown& unknown(const std::string& name) const;
  const LinkedModel& model(const std::string& name) const;
};

/// Reads recipe.yaml, or that of a folder, with all models it names. Throws InputError (one line: file, line,
/// key, found, expected) on unknown keys, methods, unknowns, models and parameters (with the nearest names),
/// missing experiments and trials, a step that needs what no earlier step gives, and wrong units.
Recipe read_recipe(const std::string& path, const effects::Catalogue& catalogue);

}  // namespace plumbline::validation
