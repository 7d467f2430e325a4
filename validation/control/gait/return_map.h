// From one passage of a section to the next: the orbit of a gait and its largest multiplier.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/control/gait/fixed_point.h"
#include "validation/control/gait/gait_run.h"

namespace plumbline::validation {

/// Where a cycle is looked at, and what a gait does not depend on: the scenario's gait, key `section`.
struct PoincareSection {
  std::string position;       ///< whose rate (or which itself) passes the level
  bool rate = true;           ///< its rate
  bool falling = true;        ///< downward; else upward
  double level = 0.0;         ///< SI
  bool in_flight = true;      ///< only while no foot is in the ground
  std::string travel;         ///< position that the gait does not depend on
  std::string travel_memory;  ///< memory of the controller that is counted along the travel; empty: none
  double per_memory = 1.0;    ///< of the travel's position for a unit of that memory
  std::vector<std::string> memory;                   ///< that is updated from cycle to cycle
  std::vector<std::pair<std::string, double>> held;  ///< constants of the controller that hold it
};
/// Nothing where the scenario's gait has none. Throws InputError.
std::optional<PoincareSection> read_section(const run::LoadedScenario& loaded);

struct Orbit {
  bool settled = false;  ///< the gait lasted until it could be looked at
  std::string why_not;
  std::vector<double> memory;      ///< of the section, at the fixed point
  double residual = 0.0;           ///< largest |P(u) - u| at the end, in steps
  int rounds = 0;                  ///< of Newton's method
  bool found = false;              ///< residual within the tolerance
  double growth = 0.0;             ///< largest |multiplier|
  double growth_held = 0.0;        ///< of the same orbit with the controller's memory held
  double growth_twice_step = 0.0;  ///< `growth` with differences twice as large
  double growth_held_twice_step = 0.0;
};

struct OrbitOptions {
  long cycles = 40;  ///< made before the orbit is looked for
  run::SampledOptions run;
  const StopFlag* stop = nullptr;
  int rounds = 4;                    ///< of Newton's method at most
  double tolerance = 0.5;            ///< residual, in steps
  work::Workers* workers = nullptr;  ///< of several ranks: points of the return map are shared among them
};

/// The return map u -> P(u) with u = (plant state at the section, travel counted from the travel's memory;
/// the section's memory). The guess is the mean of the last ten passages of a run. The steps of the
/// differences are the scatter (standard deviation) of these passages, within 1e-3 and 1e-2 for positions and
/// angles, 1e-2 and 1e-1 for their rates, 1e-5 and 1e-4 for states of contact (SI): large against what counts
/// and sampling leave. A deviated state comes with a deviated past: the controller's filters are filled with
/// the orbit's own samples before the section, moved by the deviation of position and velocity. With the
/// memory held, u has none, and no travel, of which nothing depends.
Orbit find_orbit(const run::LoadedScenario& loaded, const PoincareSection& section,
                 const OrbitOptions& options);

}  // namespace plumbline::validation
