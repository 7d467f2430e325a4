// Which feet stand where a window begins, from the recorded motion alone.
#pragma once

#include <Eigen/Core>

#include "simulator/model/plant.h"

namespace plumbline::validation {

/// Moves positions and velocities of the state x, whose other entries stay, so that feet that stand press the
/// ground as the robot's weight asks for, and no foot is deeper than that. For records without contact
/// switches: a hard ground carries a robot at half a millimetre, which no sensor's zero is good for.
///
/// A foot stands where it is within 3 cm of the ground's surface and its height changes by less than
/// 0.25 m/s. With d its depth, J = dd/dz, S = diag(deviations^2) of the positions and r the depth at which
/// its share of the weight is carried, the positions move by S J' (J S J')^-1 (r - d), the smallest way in
/// units of what the sensors leave open, and the velocities by the same with -dd/dt in place of r - d. One
/// that moves fast and is deeper than r is lifted to just touch. The next step of a search may move all this
/// again.
void stand_on_ground(model::Plant& plant, const Eigen::VectorXd& deviations, Eigen::VectorXd& x);

}  // namespace plumbline::validation
