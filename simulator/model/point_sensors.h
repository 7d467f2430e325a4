// What is measured at a point of a link: motion capture, orientation, gyroscope, accelerometer.
#pragma once

#include <Eigen/Core>

#include "simulator/model/model.h"
#include "simulator/model/tree_dynamics.h"

namespace plumbline::model {

/// The sensor's three components in SI, for a point S of a link with the sensor's axes R_WS = R_WB R_BS:
///   marker         p_WS, m, in the world's axes
///   orientation    r with exp([r]) = R_WS, |r| <= pi, rad
///   gyroscope      R_WS' w, rad/s: the link's angular velocity in the sensor's axes
///   accelerometer  R_WS' (a - g), m/s^2: specific force, +g upwards at rest
/// `tree` is placed, for gyroscopes and accelerometers also moved; `acceleration` are dv/dt of its
/// coordinates (of accelerometers alone), `body` the link in it.
Eigen::Vector3d point_reading(const TreeDynamics& tree, int body, const Sensor& sensor,
                              const Eigen::VectorXd& acceleration);

/// 3 x coordinates of the tree: d(marker)/dq; the turn about the sensor's axes for each dq of an orientation;
/// d(gyroscope)/dv; d(accelerometer)/d(dv/dt).
Eigen::Matrix3Xd point_rows(const TreeDynamics& tree, int body, const Sensor& sensor);

}  // namespace plumbline::model
