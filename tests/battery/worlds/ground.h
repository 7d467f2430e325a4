// The ground under a rig's point feet: a normal force (Hunt and Crossley 1975, with a root of the speed) and
// bristles (Canudas de Wit and others 1995) that drag along it.
#pragma once

#include "tests/battery/worlds/rig.h"

namespace plumbline::battery::worlds {

/// How deep the foot is, m, and the force on it, N.
double depth_of(const Rig& rig, const Ground& ground, const Vector& full);
double ground_force_of(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate);
/// Is the foot's switch closed? While the ground pushes with more than Rig::switch_force.
bool is_closed(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate);

/// Does its friction need a state, the bristles' deflection along x, m?
bool has_bristles(const Ground& ground);
/// What the ground does to the links' coordinates, added to `forces`; `bristle_rate` is written where there
/// are bristles.
void press(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate, double bristle,
           Vector& forces, double& bristle_rate);

}  // namespace plumbline::battery::worlds
