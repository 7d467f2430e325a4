// From one hop's apex to the next: the orbit of a hopping gait and its largest multiplier.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "validation/hopping/fixed_point.h"
#include "validation/hopping/hop_run.h"

namespace plumbline::validation {

/// Where a hop passes its apex: the hip's rate of height falls through zero in phase I.
struct Apex {
  Eigen::VectorXd state;    ///< of the plant, interpolated between two samples
  Eigen::MatrixXd history;  ///< states at the 15 samples before, one a column, oldest first, less `state`
  double h_T_d = 0.0;       ///< of the controller, rad
  double travel_at_landing = 0.0;  ///< of the last landing, at the travel's sensor
};

struct Orbit {
  bool settled = false;  ///< the gait lasted until it could be looked at
  std::string why_not;
  double h_T_d = 0.0;                  ///< rad
  double residual = 0.0;               ///< largest |P(u) - u| at the end, in steps
  int rounds = 0;                      ///< of Newton's method
  bool found = false;                  ///< residual within the tolerance
  double growth = 0.0;                 ///< largest |multiplier| with the update of the torso
  double growth_without_update = 0.0;  ///< the same orbit with h_T^d held
  double growth_twice_step = 0.0;      ///< `growth` with differences twice as large
  double growth_without_twice_step = 0.0;
};

struct OrbitOptions {
  long hops = 40;  ///< hopped before the orbit is looked for
  HopStart start;
  HopOptions run;
  int rounds = 4;          ///< of Newton's method at most
  double tolerance = 0.5;  ///< residual, in steps
};

/// The return map u -> P(u) with u = (plant state at the apex, travel counted from the last landing; h_T^d).
/// The guess is the mean of the last ten apexes of a run. The steps of the differences are the scatter
/// (standard deviation) of these apexes, within 1e-3 and 1e-2 for positions and angles, 1e-2 and 1e-1 for
/// their rates, 1e-5 and 1e-4 for states of contact (SI): large against what counts and sampling leave. A
/// deviated state comes with a deviated past: the controller's rate filters are filled with the orbit's own
/// 15 samples before the apex, moved by the deviation of position and velocity. Without the update u has no
/// h_T^d, and no travel, of which nothing depends.
Orbit find_orbit(const model::Model& model, const controllers::HoppingConfig& config,
                 const OrbitOptions& options);

}  // namespace plumbline::validation
