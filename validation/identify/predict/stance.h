// Which feet stand where a window begins, from the recorded motion alone.
#pragma once

#include <Eigen/Core>
#include <vector>

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

/// The independent positions of which no sensor says anything: those whose deviation is null
/// (model::PositionsFrom). Of a robot that floats and logs encoders and an inertial unit: where its base is.
std::vector<Eigen::Index> unseen_positions(const Eigen::VectorXd& deviations);

/// Puts a robot on the ground by what no sensor shows, and by nothing else. Its unseen positions move along
/// the mean slope of the feet's depths until the ground carries the weight at rest,
///   sum_f N_f(depth_f, 0) = m g,
/// and its unseen velocities are those with which the feet that carry it are stillest,
///   min sum_f N_f |v_f|^2.
/// Along the ground it stays where it is: on level ground nothing depends on that.
void stand_by_unseen(model::Plant& plant, const std::vector<Eigen::Index>& unseen, Eigen::VectorXd& x);

/// How far steady sliding bends the bristles of the feet, m, for each state of the plant; infinite for all
/// others. Bristles that are bent less never bend further: no foot that holds begins beyond this.
Eigen::VectorXd bent_by_sliding(const model::Plant& plant);

}  // namespace plumbline::validation
