// A periodic running motion of Thumper and the robot's unpublished numbers, as one optimisation: as near as
// possible to the published curves, subject to periodicity and to what torques and ground allow.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/optimise/least_squares.h"
#include "validation/studies/running/constants.h"
#include "validation/studies/running/hybrid.h"

namespace plumbline::validation {

/// A curve to be near to, over the time since its phase began.
struct WantedCurve {
  std::vector<double> time, value;
  double tolerance = 1.0;     ///< one residual is the difference over this
  double at(double t) const;  ///< between the points in a straight line, beyond them the last one
};

/// A number of the robot that may be chosen.
struct FreeConstant {
  std::string name;  ///< as in constant_by_name
  double start = 0.0, lower = 0.0, upper = 0.0;
  double believed = 0.0, tolerance = 0.0;  ///< residual (value - believed)/tolerance
};

/// What is wanted. The stride is cut at touchdown and at the end of compression (multiple shooting): each
/// part has its own first state and its own duration, and the constraints close the gaps. So the search may
/// begin with any guess, and no event has to be found while it goes on.
struct RunningDesign {
  monopod::Constants constants;
  std::vector<FreeConstant> free;
  monopod::Gait start;         ///< kp, kv, epsilon hold; the rest is where the search begins
  monopod::Section liftoff;    ///< where the search begins: just after lift-off
  monopod::Section touchdown;  ///< and just before touchdown
  WantedCurve torso, motor;    ///< in stance
  WantedCurve toe, shape;      ///< in flight
  double stance = 0.0, flight = 0.0, compression = 0.0;  ///< s
  double duration_tolerance = 0.0;                       ///< s; bounds of stance and flight are five of it
  double force = 0.0, force_tolerance = 1.0;             ///< of the normal force at lift-off, N
  double friction = 0.0;                                 ///< largest tangential over normal force
  double torque[2] = {0.0, 0.0};                         ///< largest, N m
  double lift = 0.0;     ///< least upward speed of the toe after lift-off, m/s
  int steps = 64;        ///< of the integration in each of the three parts; a multiple of 16
  double damping = 0.0;  ///< of the optimiser (least_squares.h)
  int iterations = 200, print_level = 0;
};

struct DesignedRunning {
  monopod::Constants constants;
  monopod::Gait gait;  ///< its gain is still zero
  monopod::Section liftoff;
  StrideFacts facts;  ///< of one stride from the section, with its events searched for
  struct Misfit {
    std::string what;
    double rms = 0.0;  ///< SI
  };
  std::vector<Misfit> misfits;  ///< of each curve
  double misfit = 0.0;          ///< root mean square of the residuals of curves and durations
  double gap = 0.0;             ///< largest gap that the optimiser left, in units of the scales
  double period_error = 0.0;    ///< largest component of the return map less its argument, after Newton
  std::string status;
  bool found = false;  ///< a periodic motion within the limits; the status says whether it is the nearest one
  int iterations = 0;
};

/// Throws std::runtime_error where what was found does not run a stride.
DesignedRunning design_running(const RunningDesign& design);

/// The fixed point of the return map of a gait that nearly has one, by Newton's method; only its section
/// changes. Returns the largest |P(x) - x| that is left. Throws
/// std::runtime_error where a neighbour falls.
double settle_on_fixed_point(const monopod::Constants& c, monopod::Gait& gait, double step, int rounds);

}  // namespace plumbline::validation
