// The torques that a trial's motion needs less those that were delivered, under any values of a model.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "validation/identify/inverse_model/measured_motion.h"

namespace plumbline::validation {

/// What does not change with the model's values: the measured motion and the commands of one trial.
struct MotionSamples {
  const Trial* trial = nullptr;
  measured::Motion motion;
  Eigen::MatrixXd commands;  ///< motors x samples, as they arrive, in command units
  /// As many independent places as there are positions: motors of the model that can move, then, where these
  /// are fewer, joints without a motor (index of the coordinate behind the number of motors).
  std::vector<int> moving;
  Eigen::MatrixXd to_places;       ///< generalised forces of the positions -> forces at these places
  Eigen::VectorXd inertia;         ///< of each, mean of (W^-T M W^-1)_ii over the motion with the model given
  double cutoff = 0.0;             ///< Hz: torques are compared below it
  double period = 0.0;             ///< s, of the samples here: every so many of the trial's (thinned)
  std::vector<Eigen::Index> used;  ///< samples away from the ends of stretches, where filters know too little
};

/// Name of a place of MotionSamples::moving.
const std::string& place_name(const model::Model& model, int place);
bool is_passive(const model::Model& model, int place);
int place_index(const model::Model& model, const std::string& name);
bool place_is_angular(const model::Model& model, int place);
/// Is it one of the six joints of a floating base?
bool floats(const model::Model& model, const std::string& name);

/// Throws InputError where the trial does not show every independent position or lacks a moving motor's
/// command, where a base floats, and where the model has hidden states.
MotionSamples motion_samples(const model::Model& model, const Trial& trial, double motion_cutoff,
                             double force_cutoff);

/// Mean over a few samples of what is made of the mass matrix there, one number for each independent
/// position.
Eigen::VectorXd mean_over_motion(const model::Model& model, const MotionSamples& samples,
                                 const std::function<Eigen::VectorXd(const Eigen::MatrixXd&)>& of);

/// Moving places x used samples, N m or N, low-passed:
///   e = W^-T (M a + h - Q(u)) / s = W^-T M (a - a(z, v, u)) / s,
/// a the measured acceleration, a(z, v, u) the model's for the commands that arrived, W the motors' positions
/// by independent position. The share s = <W^-T (Q(u) - Q(0)), t> / <t, t>, t the recorded torque of a place,
/// is what of it the model lets through: 1 without an effect in the motor's way, the factor of a torque
/// constant, less with a gear that loses or a limit. It is also the mean slope with which noise of t arrives
/// (Bussgang, Crosscorrelation functions of amplitude-distorted Gaussian signals, MIT 1952). Divided by it
/// the error is one of the recorded torque. Without that a law would gain by letting nothing through, and all
/// by becoming small together (masses, friction, torque constants). For the same reason the error at a joint
/// without a motor is divided by the joint's inertia in the model, and multiplied by the one that was given:
/// no torque is recorded there that would say how large masses are. A held command acts at a sample by the
/// mean of what was held before and after it, as the central difference of the positions sees it. Source: C.
/// G. Atkeson, C. H. An, J. M. Hollerbach, Estimation of inertial parameters of manipulator loads and links,
/// Int. J. of Robotics Research 5(3), 1986; M. Gautier, Dynamic identification of robots with power model,
/// ICRA 1997 (the same low-pass for torques and regressor).
Eigen::MatrixXd torque_errors(const model::Model& model, const MotionSamples& samples);

/// Torque gain times command, low-passed, moving places x used samples; 0 at joints without a motor.
Eigen::MatrixXd recorded_torques(const model::Model& model, const MotionSamples& samples);

}  // namespace plumbline::validation
