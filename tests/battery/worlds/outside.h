// What no catalogue has and is more than a force of a place's motion: loads that wander, a mounting that
// tilts, amplifiers, motors and sensors with faults of their own.
#pragma once

#include <cstdint>

#include "tests/battery/worlds/hidden.h"

namespace plumbline::battery::worlds {

/// What a creeping load (a point mass on a link that turns about a fixed pivot) does to its link.
struct Carried {
  double inertia = 0.0;   ///< about the pivot
  double force = 0.0;     ///< on the link's angle, its inertia left out
  double creeping = 0.0;  ///< rate of its distance
};
/// `m`: the link's angle from hanging and its rate; `moved`: how far the load has crept; gravity with its
/// components up and to the side.
Carried carried(const Hidden& load, const PlaceMotion& m, double moved, double up, double side);

/// Torque of an amplifier that turns round slowly; `sense`: its state, -1 to 1.
double turned_round(const Hidden& amplifier, double asked, double sense, double& sense_rate);

/// What a motor gives at angle x whose field weakens away from a centre.
double weakened(const Hidden& motor, double asked, double x);

/// By how many samples the reading at sample k is old; 0 at nearly all.
int held_for(double share, std::int64_t k);

/// What the heavy bit adds at this position.
double bit_error(double error, double step, double actual);

}  // namespace plumbline::battery::worlds
