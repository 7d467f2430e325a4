// The torques that a trial's motion needs less those that were delivered, under any values of a model.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/inverse_model/measured_motion.h"

namespace plumbline::validation {

/// What does not change with the model's values: the measured motion and the commands of one trial.
struct MotionSamples {
  const Trial* trial = nullptr;
  measured::Motion motion;
  Eigen::MatrixXd commands;        ///< motors x samples, as they arrive, in command units
  std::vector<int> moving;         ///< motors of the model
  Eigen::MatrixXd to_motors;       ///< generalised forces of the positions -> torques of the moving motors
  double cutoff = 0.0;             ///< Hz: torques are compared below it
  std::vector<Eigen::Index> used;  ///< samples away from the ends of stretches, where filters know too little
};

/// Throws InputError where the trial does not show every independent position, unless as many motors can move
/// as there are positions, and where the model has hidden states.
MotionSamples motion_samples(const model::Model& model, const Trial& trial, double motion_cutoff,
                             double force_cutoff);

/// Moving motors x used samples, N m or N, low-passed:
///   e = W^-T (M a + h - Q(u)) / s = W^-T M (a - a(z, v, u)) / s,
/// a the measured acceleration, a(z, v, u) the model's for the commands that arrived, W the motors' positions
/// by independent position, s the model's torque_constant_error (1 without one): divided by it, because
/// everything scales together (masses, friction, torque constants) and a small torque must be no merit.
/// A held command acts at a sample by the mean of what was held before and after it, as the central
/// difference of the positions sees it. Source: C. G. Atkeson, C. H. An, J. M. Hollerbach, Estimation of
/// inertial parameters of manipulator loads and links, Int. J. of Robotics Research 5(3), 1986; M. Gautier,
/// Dynamic identification of robots with power model, ICRA 1997 (the same low-pass for torques and
/// regressor).
Eigen::MatrixXd torque_errors(const model::Model& model, const MotionSamples& samples);

/// Torque gain times command, low-passed, moving motors x used samples.
Eigen::MatrixXd recorded_torques(const model::Model& model, const MotionSamples& samples);

}  // namespace plumbline::validation
