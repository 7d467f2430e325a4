// How finely a window has to be integrated for what the sensors can show.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/model/plant.h"

namespace plumbline::validation {

/// Of windows, and what is absolute of it where no sensor tells: a hundredth (integrate::Options).
constexpr double kRelativeTolerance = 1e-5;

/// A channel of a trial: the sensor that it is of, and its floor in SI.
struct FlooredSensor {
  int sensor = 0;
  double floor = 0.0;
};

/// Absolute tolerances of a plant's states for a window of `length` s about the state x under the command:
/// the error of a state that makes three hundredths of a floor in the channel that shows it best,
///   d_i = 0.03 min over channels of floor / |dy/dx_i|,
/// of a velocity also that which has done so after the window's whole length, d_(position)/length; of a
/// hidden state (a bristle, a delayed torque) that which does so at any time of the window through the motion
/// that it changes, its own decay counted and the motion's not: what it has done to a velocity stays. An
/// accelerometer shows every state that moves it, unmeasured positions too. A state that no channel shows
/// keeps kRelativeTolerance/100. An integrator that is held to less resolves what no measurement can confirm:
/// how a foot trembles for a millisecond when a command changes.
Eigen::VectorXd tolerances_of(model::Plant& plant, const std::vector<FlooredSensor>& channels,
                              const Eigen::VectorXd& x, const double* command, double length);

}  // namespace plumbline::validation
