// Zero errors of sensors from feet that stand: what the recorded angles alone say of them.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// The offsets o with which the feet of the recorded motion stay where they stand, on the surface of the
/// ground. Kinematics alone, no forces: with p_f(t; o) the place of foot f as the sensors say, d_f its depth,
/// <p_f> the mean of its place along the ground over one stance, D the deviations and s = 2 mm,
///   minimise |o / D|^2 + w sum over stances and samples of ((d_f - r)/s)^2 + |(p_f - <p_f>)/s|^2
/// by Gauss-Newton steps from `start`. r = 0.5 mm is the depth of a foot that carries a robot on a hard
/// ground, s what links and joints that give way leave open. Errors of neighbouring samples are alike: w
/// counts one independent sample every 20 ms.
///
/// A foot stands where it is within 3 cm of the depth that it reaches, moves by less than 0.5 m/s and stays
/// within 2 cm along the ground, for at least 80 ms; which samples these are is looked up anew at every step.
/// `with_offsets` gives the model with some offsets, rad or m, deviations are in the same units. Without a
/// stance: `start`.
Eigen::VectorXd offsets_of_standing_feet(
    const Data& data, const std::function<model::Model(const Eigen::VectorXd&)>& with_offsets,
    const Eigen::VectorXd& deviations, const Eigen::VectorXd& start);

}  // namespace plumbline::validation
