// What a trial shows of the motion of a model's independent positions, and which motors make it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/model/plant.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation::measured {

/// A cutoff, Hz, brought down to 0.4 times the sample rate where it is above.
double bounded(double cutoff, double period);

/// Signals of all independent positions, one row each, SI.
struct Motion {
  Eigen::MatrixXd z, v, a;
};

/// The independent positions from the measured channels, low-passed below `cutoff` (Hz) and weighted by the
/// sensors' floors. Sensor effects are affine, so that the outputs at zero and their slope say everything.
/// Empty when a position stays unseen.
Eigen::MatrixXd positions(model::Plant& plant, const Trial& trial, double cutoff);

///   v = (q_(k+1) - q_(k-1)) / (2 T),  a = (q_(k+1) - 2 q_k + q_(k-1)) / T^2
Motion differentiated(Eigen::MatrixXd z, double period);

/// What a motion needs may be more than a motor can give.
model::Model without_limits(model::Model model);

/// Commands as they arrive at the motors: later by the delays, no more than the limits. Motors x samples.
Eigen::MatrixXd arrived_commands(const model::Plant& plant, const Trial& trial);

/// Position (velocity) of each motor for each independent one, motors x positions.
Eigen::MatrixXd motor_map(const model::Plant& plant);

/// Rows of the map that are not zero.
std::vector<int> moving_motors(const Eigen::MatrixXd& map);

/// Why the forces at these places (motors; behind them joints without one) cannot be had from the motion;
/// empty: they can.
std::string no_inverse(const model::Plant& plant, const std::vector<int>& moving, const Trial& trial);

}  // namespace plumbline::validation::measured
